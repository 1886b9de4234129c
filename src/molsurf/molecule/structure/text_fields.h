// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Lines, blank-separated fields and numbers of a text that is in memory.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace molsurf
{

/// Steps through the lines of a text. Lines end with LF or CRLF, which are not part of line().
class LineReader
{
public:
    explicit LineReader(std::string_view text) : rest_(text) {}

    /// Goes to the next line; false after the last one.
    bool next();

    std::string_view line() const { return line_; }
    std::size_t number() const { return number_; } ///< 1 for the first line

private:
    std::string_view rest_, line_;
    std::size_t number_ = 0;
};

using Fields = std::vector<std::string_view>;

/// Fields of a line that are separated by blanks or tabs. The last of 262144 is the rest of the
/// line.
Fields splitFields(std::string_view line);

/// The same into a list that keeps its memory from line to line.
void splitFields(std::string_view line, Fields& fields);

/// Reads a decimal number that fills the whole field; a leading '+' is allowed, and so are nan,
/// inf and the D of Fortran's exponents. False, and `value` as it was, if the field holds anything
/// else.
bool parseNumber(std::string_view field, double& value);

/// The same for an integer.
bool parseInteger(std::string_view field, int& value);

/// True for 0 to 9 and for a to z and A to Z, whatever the locale.
bool isDigit(char c);
bool isLetter(char c);

/// Without the blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// True for an ATOM or HETATM line of a PDB or PQR file; the serial number may be glued to the
/// name.
bool isAtomRecord(std::string_view line);

/// Refuses a line that has coordinates and begins with a word that is nearly ATOM or HETATM, as
/// "ATAM" or "Atom". Such an atom would be lost.
/// @throws Error(ErrorKind::Input) that names the line
void refuseMisspeltAtom(const std::string& path, const LineReader& lines);

/// A text for an error message: in quotes, one line, at most 60 characters.
std::string inQuotes(std::string_view text);

/// "1, 2, 3, ...": at most `longest` names.
std::string joined(const std::vector<std::string>& names, std::size_t longest = 20);

/// The path for a message; "standard input" for "-".
std::string displayName(const std::string& path);

/// @throws Error(ErrorKind::Input) that says what is wrong with a file
[[noreturn]] void failAt(const std::string& path, const std::string& what);

/// The same for what the system refuses with the present errno.
[[noreturn]] void failBySystem(const std::string& path, const std::string& what);

/// The same with the number of the current line.
[[noreturn]] void failAtLine(const std::string& path, const LineReader& lines,
                             const std::string& what);

} // namespace molsurf
