// SPDX-License-Identifier: MPL-2.0
#include "require.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/mesh_shape.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace molsurf::tool
{

namespace
{

/// The number of closed pieces of a mesh that are walls of cavities, or that are not.
double piecesWith(const Mesh& mesh, bool cavities)
{
    const Progress nobody;
    const MeshPieces pieces = piecesOf(mesh, nobody);
    return double(
        std::count_if(pieces.measures.begin(), pieces.measures.end(),
                      [=](const PieceMeasure& piece) { return (piece.volume < 0.0) == cavities; }));
}

struct Row {
    const char* word;
    bool numbered;      ///< whether a number follows
    const char* what;   ///< it is a number of: "handles"
    bool least = false; ///< whether the number is the least one that is met
    double (*of)(const Mesh& mesh, const SurfaceReport& surface); ///< a flag gives 1 or 0
};

const Row rows[] = {
    {"watertight", false, "a closed mesh, got open edges", false,
     [](const Mesh&, const SurfaceReport& s) { return double(s.closed); }},
    {"manifold", false, "a manifold mesh, got vertices where sheets meet", false,
     [](const Mesh&, const SurfaceReport& s) { return double(s.manifold); }},
    {"components", true, "pieces that are no walls of cavities", false,
     [](const Mesh& mesh, const SurfaceReport&) { return piecesWith(mesh, false); }},
    {"cavities", true, "cavities", false,
     [](const Mesh& mesh, const SurfaceReport&) { return piecesWith(mesh, true); }},
    {"genus", true, "handles of all pieces", false,
     [](const Mesh&, const SurfaceReport& s) {
         return double(s.meshComponents) - 0.5 * double(s.meshEulerCharacteristic);
     }},
    {"min-angle", true, "degrees as the least angle", true,
     [](const Mesh& mesh, const SurfaceReport&) { return shapeOf(mesh, Progress()).leastAngle; }}};

const Row* findRow(const std::string& word)
{
    for (const Row& row : rows)
        if (word == row.word) return &row;
    return nullptr;
}

} // namespace

std::vector<std::string> requirementWords()
{
    std::vector<std::string> words;
    for (const Row& row : rows) words.push_back(row.word + std::string(row.numbered ? "=" : ""));
    return words;
}

std::optional<std::vector<Requirement>> parseRequirements(const std::string& text)
{
    std::vector<Requirement> out;
    for (const std::string& part : splitWords(text)) {
        const std::size_t equals = std::min(part.find('='), part.size());
        const Row* row = findRow(lowered(part.substr(0, equals)));
        if (!row || row->numbered != (equals < part.size())) return std::nullopt;
        Requirement one{row->word};
        const char *from = part.data() + equals + 1, *end = part.data() + part.size();
        if (row->numbered) {
            const auto [stop, problem] = std::from_chars(from, end, one.value);
            if (problem != std::errc() || stop != end || !(one.value >= 0.0)) return std::nullopt;
        }
        out.push_back(std::move(one));
    }
    if (out.empty()) return std::nullopt;
    return out;
}

void checkRequired(const std::vector<Requirement>& required, const Mesh& mesh,
                   const SurfaceReport& surface)
{
    for (const Requirement& one : required) {
        const Row& row = *findRow(one.word);
        const double has = row.of(mesh, surface);
        if (!row.numbered && has == 0.0)
            throw Error(ErrorKind::Check, "--require " + one.word + ": expected " + row.what);
        if (row.numbered && (row.least ? has < one.value : has != one.value))
            throw Error(ErrorKind::Check,
                        formatted("--require %s=%g: expected %s%g %s, got %g", row.word, one.value,
                                  row.least ? "at least " : "", one.value, row.what, has));
    }
}

} // namespace molsurf::tool
