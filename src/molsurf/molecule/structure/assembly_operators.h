// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The operators of biological assemblies, as mmCIF and PDB files write them.

#include "molsurf/molecule/structure/structure.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace molsurf
{

/// The operators that an expression may stand for, and all expressions of a file together.
constexpr std::size_t maxOperators = 100'000;

/// The motion that applies `second` first:  x -> first(second(x)).
Operator multiplied(const Operator& first, const Operator& second);

/// Operator names that an mmCIF oper_expression stands for, one list a factor.
///
/// "1,2,5-9" is one factor, "(X0)(1-60)" are two. A factor that stands further right acts first.
///
/// @throws Error(ErrorKind::Input) if the expression does not parse or a factor is empty
std::vector<std::vector<std::string>> parseOperatorExpression(const std::string& expression);

/// All products of an mmCIF oper_expression, the last factor varying fastest.
///
/// @param[in] operators  _pdbx_struct_oper_list by id
/// @throws Error(ErrorKind::Input) if the expression does not parse, names an operator that is not
///         in the list, or has more than maxOperators products
std::vector<Operator> expandOperators(const std::string& expression,
                                      const std::map<std::string, Operator>& operators);

/// The names of a list that commas separate, without blanks.
std::vector<std::string_view> splitNames(std::string_view list);

/// Reads the assemblies of REMARK 350 of a PDB file. A biomolecule may have several blocks of
/// chains and operators; without a list of chains its operators apply to all. "NULL" is the blank
/// chain name.
///
/// @param[in] remarks  lines that start with "REMARK 350"
std::vector<Assembly> parseRemark350(const std::vector<std::string_view>& remarks);

/// The assembly "ncs": the coordinates as they are given, and their copies by non-crystallographic
/// symmetry, for all chains; nothing if there are no operators.
///
/// @param[in] operators  those whose copies the file does not hold
std::optional<Assembly> ncsAssembly(std::vector<Operator> operators);

/// The same from the MTRIX records of a PDB file. Those marked as given ("1" in column 60) are
/// left out.
///
/// @param[in]  records   lines that start with "MTRIX"
/// @param[out] warnings  gets a line if a record cannot be read; there is no assembly then
std::optional<Assembly> parseMtrix(const std::vector<std::string_view>& records,
                                   std::vector<std::string>& warnings);

} // namespace molsurf
