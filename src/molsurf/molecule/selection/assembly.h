// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The copies that make a biological assembly: all of them, or each distinct one once and where it
/// is.

#include "molsurf/atoms.h"
#include "molsurf/ball.h"
#include "molsurf/molecule/structure/structure.h"

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// One copy of a part of an assembly.
struct AssemblyCopy {
    int number;       ///< in the whole assembly, from 1
    std::size_t part; ///< its index
    Operator op;
};

/// The copies of an assembly before they are made.
struct AssemblyCopies {
    std::string title;                    ///< of the assembly, for messages
    std::vector<std::vector<Ball>> parts; ///< in the coordinates of the file
    std::vector<AssemblyCopy> copies;     ///< those whose part has balls
};

/// Finds the copies of an assembly.
/// @param[in]     copies  which copies
/// @param[in]     balls   in the coordinates of the file
/// @param[in,out] out     gets the number of balls that no part of the assembly lists
/// @throws Error(ErrorKind::Input) if the file describes no such assembly, if it cannot be built,
///         or if it has no such copies
AssemblyCopies copiesOf(const Structure& structure, const std::string& name,
                        const CopyChoice& copies, const std::vector<Ball>& balls, BallSet& out);

/// The numbers of some copies of an assembly.
///
/// @param[in] balls   in the coordinates of the file
/// @throws Error as copiesOf()
std::vector<int> findCopies(const Structure& structure, const std::string& name,
                            const CopyChoice& copies, const std::vector<Ball>& balls);

/// Appends the balls of a part of an assembly as an operator moves them, in double precision from
/// the atoms' positions.
void appendCopy(const Operator& op, const std::vector<Ball>& balls, std::vector<Ball>& out);

/// Applies the operators of an assembly to the balls whose chains it lists.
///
/// Centres of atoms are computed in double precision from the atoms' positions. A part of the
/// assembly none of whose chains has a ball makes no copy.
///
/// @param[out] out  gets the balls, copy by copy
Placement expandAssembly(const AssemblyCopies& assembly, std::vector<Ball>& out);

/// Takes the prototypes of an assembly once each, and lists their copies, in the order of the
/// operators. Prototypes are the sets of chains that some operators move together; most assemblies
/// have one.
/// @param[out] out  gets the balls, prototype by prototype, in the coordinates of the file
Placement instanceAssembly(const AssemblyCopies& assembly, std::vector<Ball>& out);

/// Takes the parts of an assembly that have copies once each, and lists these copies: the same
/// whole as expandAssembly() makes, in the same order.
/// @param[out] out  gets the balls, part by part, in the coordinates of the file
Placement foldAssembly(const AssemblyCopies& assembly, std::vector<Ball>& out);

} // namespace molsurf
