// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Writes tables as .csv files (RFC 4180).

#include "molsurf/report.h"
#include "molsurf/show/io/output_file.h"

#include <charconv>
#include <string>

namespace molsurf
{

/// A text as a cell: in quotation marks if it needs them, and behind an apostrophe if a spreadsheet
/// would take it for a formula.
std::string csvCell(const std::string& text);

/// The shortest text that gives a number back.
template<typename T>
std::string digits(T value)
{
    char text[32];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// Writes the names of the columns and then the rows. Numbers have as few digits as give them back;
/// the cell of what is not a number is empty.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeCsv(const Table& table, OutputFile& file);

/// Writes the rows of a frame, which have its number in front.
/// @param[in] frame   its number in the input
/// @param[in] titled  whether the names of the columns come first
/// @throws Error(ErrorKind::Output) if the file cannot be written
void appendCsv(const Table& table, int frame, bool titled, OutputFile& file);

} // namespace molsurf
