// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The models of gemmi, which has their numbers as text up to 0.6 and as numbers from 0.7 on.

#include "molsurf/structure/text_fields.h"

#include <gemmi/model.hpp>

#include <string>

namespace molsurf
{

/// The model that a gemmi::Model is made of.
struct ModelNumber {
    int value;
    operator int() const { return value; }
    operator std::string() const { return std::to_string(value); }
};

/// Sets the number of a model, which stays as it is if the text is none.
template<typename Model>
auto setNumber(int& number, const Model& model) -> decltype(number = model.num, void())
{
    number = model.num;
}
template<typename Model>
auto setNumber(int& number, const Model& model)
    -> decltype(parseInteger(model.name, number), void())
{
    parseInteger(model.name, number);
}

} // namespace molsurf
