// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The density and the soft mask of a molecule on the pixels of a tomogram: a template and a mask
/// for RELION, pytom-match-pick, cryoCAT and the like.

#include "molsurf/atoms.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/write_volume.h"
#include "molsurf/surface/product_cost.h"

#include <vector>

namespace molsurf
{

/// The pixels of both maps, and the rim of the mask.
struct TomogramSettings {
    double pixel = 0.0;      ///< edge [Å]; 0: not known
    int box = 0;             ///< edge of the cube [pixel], even; 0: the least that holds both maps
    double maskExtend = 0.0; ///< how far outside of the surface the mask is 1 [pixel]
    double maskEdge = 3.0;   ///< width over which it falls to 0 [pixel]
    bool invert = false;     ///< the density is negative, as matter is in a tomogram
};

/// The pixels: the mean place of the atoms, weighted by their atomic numbers, is the centre of the
/// pixel with the number box/2 on each axis, counted from 0, about which these programs turn maps.
/// @throws Error(ErrorKind::Usage) if there is no pixel size, or the atoms are not the whole
/// @throws Error(ErrorKind::Input) if the box does not hold them, or is larger than 2^31 pixels
PixelBox tomogramBox(const BallSet& atoms, const TomogramSettings& settings);

/// The sum of a Gaussian for each atom, whose integral is the atomic number: the density of
/// ChimeraX's molmap, with a standard deviation of d/(pi sqrt 2) for a resolution d [e/Å^3]. Atoms
/// without a resolution have that of three pixels, those without an element that of carbon.
/// @return x fastest, z slowest
std::vector<float> tomogramDensity(const BallSet& atoms, const TomogramSettings& settings,
                                   const PixelBox& box, const Progress& progress);

/// 1 inside of a surface and up to maskExtend pixels outside of it, then half a period of a cosine
/// over maskEdge pixels, and 0.
/// @param[in] mesh  closed, in the frame of the atoms
std::vector<float> softMask(const Mesh& mesh, const TomogramSettings& settings, const PixelBox& box,
                            const Progress& progress);

/// What the density and the mask take.
Cost costOfDensity(const BallSet& atoms, const TomogramSettings& settings);
Cost costOfMask(const BallSet& atoms, const TomogramSettings& settings);

} // namespace molsurf
