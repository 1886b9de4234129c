# SPDX-License-Identifier: MPL-2.0
"""Solvent-accessible areas of Biopython's entities, and depths of their residues."""

import numpy as np

from . import _adapters, _arrays
from ._surface import surface

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
        raise TypeError(f"entity: expected one of Bio.PDB, got {type(entity).__name__} "
                        "[hint: Bio.PDB.PDBParser().get_structure(\"name\", FILE)]")
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
    positions = _arrays.points([atom.get_coord() for atom in atoms], "coordinates")
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


def residue_depth(entity, probe_radius=1.4, radii="bondi", voxel=0.5):
    """How deep residues lie below the solvent-excluded surface [Å], as Bio.PDB.ResidueDepth tells, without MSMS.

    Returns a dict: (chain, residue.id) -> (mean over the atoms, that of CA; None without one). Atoms that have no
    radius are left out. Depths are to the outer surface itself, and not to the nearest of its vertices, and negative
    where an atom's centre lies outside. Of a structure the first model is taken.

    radii: as of compute(). voxel: of the surface [Å].
    """
    model = next(iter(entity)) if getattr(entity, "level", "") == "S" else entity
    if not hasattr(model, "get_atoms"):
        raise TypeError(f"entity: expected one of Bio.PDB, got {type(entity).__name__} "
                        "[hint: Bio.PDB.PDBParser().get_structure(\"name\", FILE)]")
    atoms = list(model.get_atoms())
    known = _adapters.radii_of(radii, [atom.get_name() for atom in atoms],
                               [atom.get_parent().get_resname().strip() for atom in atoms],
                               [atom.element or "" for atom in atoms])
    kept = np.flatnonzero(known > 0)
    if not len(kept):
        raise ValueError("entity: expected at least one atom with a radius, got none")
    positions = _arrays.points([atoms[i].get_coord() for i in kept], "coordinates")
    made = surface(positions, known[kept], kind="ses", probe=probe_radius, voxel=voxel, fill_cavities=True)
    depths = {}
    for i, depth in zip(kept, -made.distance(positions).distance):
        depths.setdefault(atoms[i].get_parent(), {})[atoms[i].get_name()] = float(depth)
    return {(residue.get_parent().id, residue.id): (float(np.mean(list(depth.values()))), depth.get("CA"))
            for residue, depth in depths.items()}
