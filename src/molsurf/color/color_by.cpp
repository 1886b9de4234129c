// SPDX-License-Identifier: MPL-2.0
#include "molsurf/options.h"

namespace molsurf
{

const char* nameOf(ColorBy color)
{
    switch (color) {
    case ColorBy::Chain:
        return "chain";
    case ColorBy::Group:
        return "group";
    case ColorBy::Element:
        return "element";
    case ColorBy::Residue:
        return "residue";
    case ColorBy::Nucleotide:
        return "nucleotide";
    case ColorBy::Plain:
        return "plain";
    case ColorBy::MeanCurvature:
        return "mean-curvature";
    case ColorBy::GaussianCurvature:
        return "gaussian-curvature";
    case ColorBy::Value:
        return "value";
    default:
        return "none";
    }
}

} // namespace molsurf
