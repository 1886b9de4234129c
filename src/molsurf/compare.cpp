// SPDX-License-Identifier: MPL-2.0
#include "molsurf/compare.h"

#include "molsurf/error.h"
#include "molsurf/mesh/check_arrays.h"
#include "molsurf/surface/compare.h"

namespace molsurf
{

Comparison compare(const Mesh& a, const Mesh& b, Progress* listener)
{
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    for (const Mesh* mesh : {&a, &b}) {
        if (mesh->triangles.empty())
            throw Error(ErrorKind::Input, "compare: expected triangles, got a mesh without any");
        checkArrays(*mesh);
    }
    const Operand first = operandOf(a, progress), second = operandOf(b, progress);
    const DistanceTo toA(first.surface), toB(second.surface);
    return compare(first, toA, second, toB, progress);
}

} // namespace molsurf
