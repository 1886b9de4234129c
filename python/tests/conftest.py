# SPDX-License-Identifier: MPL-2.0
import pathlib

import pytest

import vdb_molsurf as ms

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "data"


@pytest.fixture(scope="session")
def crambin():
    """The protein 1CRN, which no test changes."""
    return ms.read(DATA / "1crn.pdb")


@pytest.fixture(scope="session")
def ses(crambin):
    """Its solvent-excluded surface, which no test changes."""
    return crambin.surface(kind="ses")
