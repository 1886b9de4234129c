// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// psi at a point with its derivatives.

#include <openvdb/Types.h>

#include <functional>

namespace molsurf
{

/// psi, its gradient and its Hessian at a point.
struct PsiJet {
    double psi;
    openvdb::Vec3d gradient; ///< [1/Å]
    openvdb::Mat3d hessian;  ///< [1/Å^2]
};
using PsiJetAt = std::function<PsiJet(const openvdb::Vec3d&)>;

} // namespace molsurf
