# SPDX-License-Identifier: MPL-2.0
"""Areas and volumes over trajectories, as an analysis class of MDAnalysis."""

import numpy as np
from MDAnalysis.analysis.base import AnalysisBase
from MDAnalysis.analysis.results import ResultsGroup

from . import _adapters, _surface


class SurfaceAnalysis(AnalysisBase):
    """The surface of a group of atoms, frame by frame.

        run = SurfaceAnalysis(universe.select_atoms("protein"), kind="sas").run(step=10)
        run.results.residue_area

    kind: "sas" (the default), "vdw" and "ses" are exact and need no mesh; the others have one.
    radii: the name of a set, "bondi" unless given, or an array of one radius an atom [Å]. Radii of MDAnalysis are not
    taken. Elements are those of the topology; without them the names of the atoms tell.
    Other keywords are those of vdb_molsurf.surface().

    Results, in Å² and Å³: `total_area` and `volume` (frames,), `atom_area` (frames, atoms), `residue_area`
    (frames, residues), and for sas with a probe of 1.4 `relative` (frames, residues), the share of the largest
    accessible area. Residues are those of `atomgroup.residues`; pieces of one, as hydrogens at the end of a file, have
    the share of the whole. In parallel by run(backend="multiprocessing",
    n_workers=4).
    """

    _analysis_algorithm_is_parallelizable = True

    @classmethod
    def get_supported_backends(cls):
        return "serial", "multiprocessing", "dask"

    def __init__(self, atomgroup, kind="sas", radii="bondi", **options):
        if not hasattr(atomgroup, "positions") and hasattr(atomgroup, "atoms"):
            atomgroup = atomgroup.atoms  # a Universe
        if not hasattr(atomgroup, "positions"):
            raise TypeError(f"atomgroup: expected atoms of MDAnalysis, got {type(atomgroup).__name__} "
                            "[hint: MDAnalysis.Universe(FILE).select_atoms(\"protein\")]")
        super().__init__(atomgroup.universe.trajectory)
        if len(atomgroup) == 0:
            raise ValueError("atomgroup: expected at least one atom, got none")
        self._atoms = atomgroup
        names = atomgroup.names
        elements = getattr(atomgroup, "elements", None)
        self.radii = _adapters.radii_of(radii, names, atomgroup.resnames, elements)
        self._kept = self.radii > 0
        self._options = {"kind": kind, **options}
        if kind in ("ses", "sas", "vdw"):
            self._options.setdefault("grid", False)
        self._residues = atomgroup.residues
        place = {index: k for k, index in enumerate(self._residues.resindices)}
        self._residue_of = np.array([place[index] for index in atomgroup.resindices], dtype=np.intp)
        own = [set() for _ in self._residues]
        for name, k in zip(names, self._residue_of):
            own[k].add(str(name))
        firsts = [residue.atoms[0] for residue in self._residues]
        self._whole_of = _adapters.whole_residues(
            [(atom.segid, getattr(atom, "chainID", ""), int(atom.resid), getattr(atom, "icode", ""), atom.resname)
             for atom in firsts], own)

    def _prepare(self):
        self.results.atom_area = np.zeros((self.n_frames, len(self._atoms)))
        self.results.total_area = np.zeros(self.n_frames)
        self.results.volume = np.zeros(self.n_frames)

    def _single_frame(self):
        k = self._frame_index
        made = _surface.surface(self._atoms.positions[self._kept], self.radii[self._kept], **self._options)
        self.results.atom_area[k, self._kept] = made.atom_areas
        self.results.total_area[k] = made.area
        self.results.volume[k] = made.volume

    def _get_aggregator(self):
        return ResultsGroup(lookup={"atom_area": ResultsGroup.ndarray_vstack,
                                    "total_area": ResultsGroup.ndarray_hstack,
                                    "volume": ResultsGroup.ndarray_hstack})

    def _conclude(self):
        areas = self.results.atom_area
        self.results.residue_area = (_adapters.sums(areas, self._residue_of, len(self._residues)) if len(areas)
                                     else np.zeros((0, len(self._residues))))
        if self._options["kind"] == "sas" and self._options.get("probe", 1.4) == 1.4:
            areas = self.results.residue_area
            if len(areas):
                areas = _adapters.sums(areas, self._whole_of, len(self._residues))[:, self._whole_of]
            self.results.relative = areas / _adapters.largest_areas(self._residues.resnames)
