# SPDX-License-Identifier: MPL-2.0
"""Molecular surfaces of atoms as NumPy arrays, exact areas, contacts and OpenVDB level sets.

    import vdb_molsurf as ms
    s = ms.surface(positions, radii, kind="ses", voxel=0.5)
    s.vertices, s.faces, s.area, s.volume

Lengths are in Å, areas in Å², volumes in Å³.
"""

from . import _core
from ._core import CheckError, InputError, NumericError, OptionError, OutputError
from ._many import Shard, map, measure, shards
from ._molecule import Molecule, Selection, radii, read
from ._surface import (Comparison, Contacts, Distances, Page, Samples, Surface, Voxels, areas, compare, contacts,
                       surface)

__version__ = _core.__version__
__all__ = ["CheckError", "Comparison", "Contacts", "Distances", "InputError", "Molecule", "NumericError",
           "OptionError", "OutputError", "Page", "Samples", "Selection", "Shard", "Surface", "Voxels", "areas", "compare", "contacts", "map",
           "measure", "radii", "read", "shards", "surface"]


def __getattr__(name):
    """The adapters, which need the packages that they are for."""
    if name in ("mdanalysis", "mdtraj", "biopython"):
        import importlib
        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


def __dir__():
    return [*__all__, "__version__", "biopython", "mdanalysis", "mdtraj"]
