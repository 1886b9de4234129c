# SPDX-License-Identifier: MPL-2.0
"""Atoms out of files."""

import errno
import os
import warnings

import numpy as np

from . import _arrays, _core, _options
from ._surface import Surface, _called, _made, _split


class Selection:
    """Atoms of a molecule that Molecule.select() found."""

    __slots__ = ("molecule", "indices")

    def __init__(self, molecule, indices):
        self.molecule, self.indices = molecule, indices

    def __len__(self):
        return len(self.indices)

    def __repr__(self):
        return f"<Selection: {len(self)} of {len(self.molecule)} atoms>"

    @property
    def count(self):
        """How many atoms it has."""
        return len(self.indices)

    @property
    def mask(self):
        """Whether each atom of the molecule is among them, (n,) bool."""
        found = np.zeros(len(self.molecule), bool)
        found[self.indices] = True
        return found

    @property
    def positions(self):
        """A copy of their positions, (count, 3) float64 [Å]."""
        return self.molecule.positions[self.indices]


class Molecule:
    """Atoms of a file, or of an assembly of it, as arrays: what read() makes.

    `positions` and `radii` are views of its memory: what is written there is what surface() takes. With `by_symmetry`
    and `instances` the atoms are those that the whole repeats, and the views are read-only.
    """

    __slots__ = ("_core", "_given", "_names")

    def __init__(self, core, given):
        self._core, self._given, self._names = core, given, None

    def __len__(self):
        return len(self._core)

    def __repr__(self):
        return f"<Molecule {os.path.basename(self._core.source)[:40]}: {len(self)} atoms, {len(np.unique(self.chain))} chains>"

    def __reduce__(self):
        return Molecule, (self._core, self._given)

    def _column(self, name):
        if self._names is None:
            self._names = _arrays.texts(self._core.names)
        return self._names[name]

    @property
    def positions(self):
        """Positions of the atoms, (n, 3) float64 [Å]."""
        return self._core.positions

    @property
    def radii(self):
        """Radii of the atoms, (n,) float64 [Å]."""
        return self._core.radii

    @property
    def name(self):
        """Names of the atoms: "CA"."""
        return self._column("atom")

    @property
    def element(self):
        """Atomic numbers, (n,) int32; 0: unknown."""
        return self._column("element")

    @property
    def residue(self):
        """Name of each atom's residue: "ALA"."""
        return self._column("residue")

    @property
    def residue_number(self):
        """Author's number of each atom's residue, (n,) int32."""
        return self._column("number")

    @property
    def insertion_code(self):
        """Insertion code of each atom's residue, "" without one."""
        return self._column("insertion_code")

    @property
    def residue_index(self):
        """Each atom's residue, counted from 0, (n,) int32."""
        return self._column("residue_index")

    @property
    def chain(self):
        """Author's name of each atom's chain; in an assembly's second copy "A-2"."""
        return self._column("chain")

    @property
    def altloc(self):
        """Alternate location of each atom, "" without one."""
        return self._column("altloc")

    @property
    def atom_id(self):
        """Place of each atom in its file, from 0, (n,) int32."""
        return self._column("atom_id")

    @property
    def copies(self):
        """How many copies the assembly has; 1 without one."""
        return self._core.copies

    @property
    def groups(self):
        """Names of the groups."""
        return self._core.groups

    @property
    def warnings(self):
        """What the reader had to say, a line each."""
        return self._core.warnings

    def _keys(self, names, chains):
        """The places of carbon atoms of these names, by chain (if it counts), number, insertion code and name."""
        taken = np.flatnonzero(np.isin(self.name, list(names)) & (self.element == 6))
        return {(str(self.chain[i]) if chains else "", int(self.residue_number[i]), str(self.insertion_code[i]),
                 str(self.name[i])): i for i in taken[::-1]}

    def superpose(self, onto, names=("CA", "C4'")):
        """Moves the atoms rigidly onto those of another molecule, with the least root mean square distance (Kabsch).

        onto: a Molecule, which stays where it is.
        names: names of the carbon atoms that count, where chain, number, insertion code and name are the same in both;
        the chain does not count where each of the two has one.

        Returns that distance, rmsd [Å], a float. `positions` are the new ones.

        Raises ValueError if fewer than three pairs are common or they lie on one line, or if the molecule has copies that
        are not among its atoms (by_symmetry, instances).
        """
        if not isinstance(onto, Molecule):
            raise TypeError(f"onto: expected a Molecule, got {type(onto).__name__}")
        if not self._core.is_whole:
            raise ValueError("superpose: expected atoms of the whole, not of by_symmetry or instances")
        chains = len(np.unique(self.chain)) > 1 or len(np.unique(onto.chain)) > 1
        own, other = self._keys(names, chains), onto._keys(names, chains)
        common = [key for key in own if key in other]
        a, b = (np.array(m.positions[[keys[key] for key in common]]).reshape(-1, 3) for m, keys in ((self, own), (onto, other)))
        if len(common) < 3 or np.linalg.matrix_rank(a - a.mean(axis=0), tol=1e-6) < 2 or \
                np.linalg.matrix_rank(b - b.mean(axis=0), tol=1e-6) < 2:
            raise ValueError(f"superpose: expected at least three common atoms that are not on one line, got {len(common)}")
        u, _, vt = np.linalg.svd((a - a.mean(axis=0)).T @ (b - b.mean(axis=0)))
        u[:, 2] *= np.sign(np.linalg.det(u @ vt)) # no mirror image
        turn = u @ vt
        self.positions[:] = (self.positions - a.mean(axis=0)) @ turn + b.mean(axis=0)
        return float(np.sqrt((((a - a.mean(axis=0)) @ turn + b.mean(axis=0) - b) ** 2).sum(axis=1).mean()))

    def select(self, selection):
        """Finds the atoms that a selection takes, as "chain A and resid 5-9" or "within 4 of resname HEM".

        selection: text in the words of the command line's --select; it may name atoms of the file that the molecule has
        not, as waters.

        Returns a Selection of the molecule's own atoms: `count`, `indices` (count,) int32 into its arrays, `mask`.

        Raises OptionError if the text cannot be parsed, InputError if the file has no such atom, ValueError of a pickle.
        """
        return Selection(self, self._core.select(str(selection)))

    def surface(self, **options):
        """Makes the surface of the atoms. Those keywords that read() was given are the defaults.

        Returns a Surface. Raises what surface() raises, and OptionError or InputError for questions about the atoms
        (pore, pocket_at, group_by) that the file cannot answer.

        Keywords:
        """
        if not self._core.is_whole:
            options.setdefault("atom_areas", False)
        options, extra, areas_of, how = _split(options)
        pairs = _options.given(options, "molecule", _options.MORE)
        known = dict(self._given)
        again = any(values != known.get(name) and
                    (_options.SETTINGS[name]["of"] == "molecule" or (name == "color" and _core.is_of_file(values[0])))
                    for name, values in pairs)
        named = {name for name, _ in pairs}
        made = _made([pair for pair in self._given if pair[0] not in named] + pairs, extra, areas_of)
        if any(name in ("split", "surface-of") for name, _ in made[0]) and not self.groups and \
                "group-by" not in named:
            raise ValueError("split and surface_of: expected groups [hint: surface(..., group_by=\"chain\")]")
        return Surface(_called(self._core.surface, *made, again, **how), made)


Molecule.surface.__doc__ = Molecule.surface.__doc__.rstrip() + "\n" + _options.documented("molecule") + "\n"


def read(source, *, groups=None, progress=None, threads=0, **options):
    """Reads the atoms of a structure file and chooses which of them the surface has.

    The format is found by the content: PDB, mmCIF, BinaryCIF, gro, sdf, mol2, PQR, PDBQT, xyz, xyzr or xyzrn, also
    compressed by gzip, bzip2 or xz.

    source: a path, the text of a file (with a line feed in it), its bytes, or an object with a method read().
    groups: selections by the name of a group, as {"site": "resid 5-9"}.
    progress: a function of stage and fraction; True shows a bar of tqdm.
    threads: threads at most; 0: all.

    Keywords of surface() are taken, too, and are the defaults of Molecule.surface(). Questions about the atoms, as pore,
    pocket_at and palette, are for Molecule.surface(): here they give a DeprecationWarning.

    Returns a Molecule: positions (n, 3) and radii (n,) float64 [Å], names, residues and chains of the n atoms.

    Raises FileNotFoundError or IsADirectoryError for the path, InputError (a ValueError) if the file cannot be read or a
    selection matches no atom, TypeError for an unknown keyword, OptionError for a value out of range.

    Keywords:
    """
    asked = sorted(_options.ASKED_LATER & {name for name, value in _options.today(options).items() if value is not None})
    if asked:
        warnings.warn(f"read: {', '.join(asked)} will be of Molecule.surface() alone", DeprecationWarning, stacklevel=2)
    return _read(source, groups, progress, threads, options)


def _read(source, groups, progress, threads, options):
    """read(), and what asks for the surface at once."""
    given = _options.given(options, "atoms", ("groups", "progress", "threads"))
    if groups is not None and not (hasattr(groups, "items") and all(
            isinstance(k, str) and isinstance(v, str) for k, v in groups.items())):
        raise TypeError("groups: expected a dict of selections by name")
    if groups and any(name == "group-by" for name, _ in given):
        raise ValueError("groups and group_by together")
    if hasattr(source, "read"):
        source = source.read()
    if isinstance(source, str) and "\n" in source:
        source = source.encode()
    if isinstance(source, (bytes, bytearray, memoryview)):
        name, content = "text", bytes(source)
    elif isinstance(source, (str, os.PathLike)):
        name, content = os.fspath(source), None
        if name == "-" or not os.path.exists(name):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), name[:120])
        if os.path.isdir(name):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), name[:120])
    else:
        raise TypeError(f"source: expected a path, text, bytes or a file, got {type(source).__name__}")
    core = _called(_core.read, name, content, given, list((groups or {}).items()), progress=progress, threads=threads)
    return Molecule(core, given)


read.__doc__ = read.__doc__.rstrip() + "\n" + _options.documented("read") + "\n"


def radii(names, residues=None, elements=None, set="bondi"):
    """Radii of atoms by their names, residues and elements, (n,) float64 [Å].

    set: bondi, alvarez, gemmi; of heavy atoms with their hydrogens protor or naccess; martini2, martini3; or the path
    of a file. 0 stands for an atom that is to be left out, not a number for one of which nothing is known.
    """
    lists = (_arrays.words(values, name)
             for name, values in (("names", names), ("residues", residues), ("elements", elements)))
    return _core.radii(*lists, str(set))
