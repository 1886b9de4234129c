# SPDX-License-Identifier: MPL-2.0
"""Solvent-accessible areas of Biopython's entities."""

import numpy as np

from . import _adapters

LEVELS = ("A", "R", "C", "M", "S")


def compute(entity, level="A", probe_radius=1.4, radii="bondi"):
    """Sets `.sasa` [Å²] of all atoms of an entity, and of what they are in up to a level, exact, as
    Bio.PDB.SASA.ShrakeRupley.compute() does.

    level: "A", "R", "C", "M" or "S": atoms, residues, chains, models, the structure.
    radii: the name of a set of vdb_molsurf, "bondi" unless given, or an array of one radius an atom [Å]. Biopython's
    own are not taken. Each model of a structure has areas of its own.
    """
    if level not in LEVELS:
        raise ValueError(f"level: expected {', '.join(LEVELS)}, got '{str(level)[:40]}'")
    if not hasattr(entity, "get_atoms"):
        raise TypeError(f"entity: expected one of Bio.PDB, got {type(entity).__name__}")
    if level != "A" and LEVELS.index(level) > LEVELS.index(entity.level):
        raise ValueError(f"level: expected one up to {entity.level}, that of the entity, got {level}")
    atoms = list(entity.get_atoms())
    if not atoms:
        raise ValueError("entity: expected at least one atom, got none")
    known = _adapters.radii_of(radii, [atom.get_name() for atom in atoms],
                               [atom.get_parent().get_resname().strip() for atom in atoms],
                               [atom.element or "" for atom in atoms])
    models = {}
    for i, atom in enumerate(atoms):
        models.setdefault(id(_up(atom, "M")), []).append(i)
    positions = np.array([atom.get_coord() for atom in atoms], dtype=np.float64)
    for members in models.values():
        for i, area in zip(members, _adapters.areas(positions[members], known[members], probe_radius)):
            atoms[i].sasa = float(area)
    for upper in LEVELS[1:LEVELS.index(level) + 1]:
        sums = {}
        for atom in atoms:
            part = _up(atom, upper)
            sums[id(part)] = (part, sums.get(id(part), (part, 0.0))[1] + atom.sasa)
        for part, total in sums.values():
            part.sasa = total


def _up(atom, level):
    """What an atom is in; the highest there is if it is in nothing of that level."""
    part = atom.get_parent()
    while part.get_parent() is not None and LEVELS.index(part.level) < LEVELS.index(level):
        part = part.get_parent()
    return part
