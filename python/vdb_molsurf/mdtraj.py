# SPDX-License-Identifier: MPL-2.0
"""Solvent-accessible areas of trajectories of MDTraj, in its units."""

import numpy as np

from . import _adapters, _arrays


def shrake_rupley(traj, probe_radius=0.14, mode="atom", radii="bondi"):
    """The solvent-accessible area of every atom or residue in every frame, exact, as mdtraj.shrake_rupley() has it.

    probe_radius: in nm. mode: "atom" or "residue".
    radii: the name of a set of vdb_molsurf, "bondi" unless given, or an array of one radius an atom in nm. MDTraj's own
    are not taken.
    Returns (frames, atoms) or (frames, residues), float32, nm².
    """
    if mode not in ("atom", "residue"):
        raise ValueError(f"mode: expected atom or residue, got '{str(mode)[:40]}'")
    if not hasattr(traj, "topology") or not hasattr(traj, "xyz"):
        raise TypeError(f"traj: expected a trajectory of MDTraj, got {type(traj).__name__} [hint: mdtraj.load(FILE)]")
    atoms = list(traj.topology.atoms)
    if isinstance(radii, str):
        known = _adapters.radii_of(radii, [atom.name for atom in atoms], [atom.residue.name for atom in atoms],
                                   ["" if atom.element is None else atom.element.symbol for atom in atoms])
    else:
        known = 10.0 * _adapters.radii_of(radii, atoms, None, None)
    areas = np.zeros((traj.n_frames, len(atoms)))
    for k, frame in enumerate(traj.xyz):
        areas[k] = _adapters.areas(10.0 * _arrays.points(frame, "traj.xyz"), known, 10.0 * probe_radius)
    if mode == "residue":
        index = np.array([atom.residue.index for atom in atoms], dtype=np.intp)
        areas = (_adapters.sums(areas, index, traj.topology.n_residues) if len(areas)
                 else np.zeros((0, traj.topology.n_residues)))
    return (areas / 100.0).astype(np.float32)
