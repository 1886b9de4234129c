# SPDX-License-Identifier: MPL-2.0
"""What the adapters to other packages share: radii, and areas of atoms some of which have none."""

import numpy as np

from . import _arrays, _core, _molecule, _surface


def radii_of(radii, names, residues, elements):
    """Radii of atoms: those of a set, by its name, or numbers as they are; 0 leaves an atom out."""
    if not isinstance(radii, str):
        numbers = _arrays.numbers(radii, "radii")
        numbers = np.full(len(names), float(numbers)) if numbers.ndim == 0 else numbers
        if numbers.shape != (len(names),):
            raise ValueError(f"radii: expected a number or shape ({len(names)},), got {numbers.shape}")
        return numbers
    found = _molecule.radii(names, residues, elements, radii)
    unknown = np.flatnonzero(np.isnan(found))
    if len(unknown):
        some = sorted({str(names[i]) for i in unknown[:1000]})[:5]
        raise ValueError(f"radii: {radii} has none for {len(unknown)} atoms, {', '.join(some)} "
                         "[hint: leave them out, or give radii as an array]")
    return found


def largest_areas(residues):
    """The largest accessible area of each residue, not a number for what is no amino acid."""
    known = {name: _core.largest_area(str(name)) for name in set(residues)}
    return np.array([np.nan if known[name] is None else known[name] for name in residues], dtype=np.float64)


def whole_residues(keys, names):
    """For each residue the first one that it is a piece of, as hydrogens at the end of a file: of the same key, and
    without a name that comes again."""
    first, known = [], {}
    for index, (key, own) in enumerate(zip(keys, names)):
        same = known.setdefault(key, [])
        found = next((whole for whole in same if not own & whole[1]), None)
        if found is None:
            found = (index, set())
            same.append(found)
        found[1].update(own)
        first.append(found[0])
    return np.array(first, dtype=np.intp)


def areas(positions, radii, probe):
    """Areas of all atoms; those without a radius have none and cover nothing."""
    out = np.zeros(len(radii))
    kept = radii > 0
    if kept.any():
        out[kept] = _surface.areas(_arrays.points(positions, "positions")[kept], radii[kept], probe)
    return out


def sums(values, index, count):
    """Sums of the last axis by index."""
    values = np.atleast_2d(values)
    return np.stack([np.bincount(index, weights=row, minlength=count) for row in values])
