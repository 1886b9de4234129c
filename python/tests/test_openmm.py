# SPDX-License-Identifier: MPL-2.0
"""The recipe of docs/electrostatics.md in OpenMM: a force is the derivative of its energy."""

import io
import re

import numpy as np
import pytest

from conftest import ROOT

openmm = pytest.importorskip("openmm")
if not hasattr(openmm, "PythonForce"):
    pytest.skip("OpenMM older than 8.6 has no PythonForce", allow_module_level=True)

from openmm import app, unit  # noqa: E402

# ACE ALA NME as a force field's residues, bonds at their usual lengths.
ATOMS = """ACE HH31 2.000 1.000 0.000
ACE CH3 2.000 2.090 0.000
ACE HH32 1.486 2.454 0.890
ACE HH33 1.486 2.454 -0.890
ACE C 3.427 2.641 0.000
ACE O 4.391 1.877 0.000
ALA N 3.555 3.970 0.000
ALA H 2.733 4.556 0.000
ALA CA 4.853 4.614 0.000
ALA HA 5.408 4.316 0.890
ALA CB 5.661 4.221 -1.232
ALA HB1 5.123 4.521 -2.131
ALA HB2 6.630 4.719 -1.206
ALA HB3 5.809 3.141 -1.241
ALA C 4.713 6.129 0.000
ALA O 3.601 6.653 0.000
NME N 5.846 6.835 0.000
NME H 6.737 6.359 0.000
NME C 5.846 8.284 0.000
NME H1 4.819 8.648 0.000
NME H2 6.360 8.648 0.890
NME H3 6.360 8.648 -0.890"""


def recipe():
    page = (ROOT / "docs" / "electrostatics.md").read_text()
    block = next(b for b in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "PythonForce" in b)
    names = {}
    exec(block, names)
    return names["surface_force"]


def dipeptide():
    """A PDB file of alanine dipeptide, as OpenMM reads it."""
    lines = []
    for i, row in enumerate(ATOMS.splitlines(), 1):
        residue, name, *place = row.split()
        number = 1 + ["ACE", "ALA", "NME"].index(residue)
        lines.append("ATOM  %5d %-4s %3s A%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s" %
                     (i, name if len(name) == 4 else " " + name, residue, number, *map(float, place), name[0]))
    return app.PDBFile(io.StringIO("\n".join(lines + ["END"])))


@pytest.mark.parametrize("kind,options,tolerance", [("sas", {"grid": False}, 1e-3), ("variational", {"voxel": 0.25}, 0.03)])
def test_a_force_of_openmm_is_a_derivative(kind, options, tolerance):
    pdb = dipeptide()
    system = openmm.System()
    for _ in pdb.topology.atoms():
        system.addParticle(12)
    gamma = 2.0
    system.addForce(recipe()(pdb.topology, gamma=gamma, kind=kind, **options))
    context = openmm.Context(system, openmm.VerletIntegrator(0.001), openmm.Platform.getPlatformByName("Reference"))
    start = pdb.getPositions(asNumpy=True).value_in_unit(unit.nanometer)

    def state(places):
        context.setPositions(places)
        return context.getState(getEnergy=True, getForces=True)

    energy = lambda places: state(places).getPotentialEnergy().value_in_unit(unit.kilojoule_per_mole)
    forces = state(start).getForces(asNumpy=True).value_in_unit(unit.kilojoule_per_mole / unit.nanometer)
    assert energy(start) > 100 * gamma  # more than 100 Å²
    rms = np.sqrt((forces**2).mean())
    step = 1e-3 if kind == "sas" else 5e-3  # nm
    for atom, axis in (10, 2), (15, 0), (21, 1):
        more, less = start.copy(), start.copy()
        more[atom, axis] += step
        less[atom, axis] -= step
        difference = (energy(more) - energy(less)) / (2 * step)
        assert forces[atom, axis] == pytest.approx(-difference, abs=tolerance * rms + 2e-3 * abs(difference))
