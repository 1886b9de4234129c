// SPDX-License-Identifier: MPL-2.0
#include "require.h"

#include "molsurf/core/words.h"
#include "molsurf/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace molsurf::tool
{

namespace
{

/// The least angle of all triangles [degree]; 0 if one has no area.
double leastAngle(const Mesh& mesh)
{
    double largest = -1.0; // cosine
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const openvdb::Vec3d x(mesh.positions[t[k]]);
            const openvdb::Vec3d a = openvdb::Vec3d(mesh.positions[t[(k + 1) % 3]]) - x;
            const openvdb::Vec3d b = openvdb::Vec3d(mesh.positions[t[(k + 2) % 3]]) - x;
            const double lengths = a.length() * b.length();
            largest = std::max(largest, lengths > 0.0 ? a.dot(b) / lengths : 1.0);
        }
    return std::acos(std::min(largest, 1.0)) * 180.0 / M_PI;
}

struct Row {
    const char* word;
    bool numbered;      ///< whether a number follows
    const char* what;   ///< it is a number of: "handles"
    bool least = false; ///< whether the number is the least one that is met
    double (*of)(const Mesh& mesh, const SurfaceReport& surface); ///< a flag gives 1 or 0
};

const Row rows[] = {{"watertight", false, "a closed mesh, got open edges", false,
                     [](const Mesh&, const SurfaceReport& s) { return double(s.closed); }},
                    {"manifold", false, "a manifold mesh, got vertices where sheets meet", false,
                     [](const Mesh&, const SurfaceReport& s) { return double(s.manifold); }},
                    {"components", true, "pieces that are no walls of cavities", false,
                     [](const Mesh&, const SurfaceReport& s) {
                         return double(s.meshComponents) - double(s.cavities.size());
                     }},
                    {"cavities", true, "cavities", false,
                     [](const Mesh&, const SurfaceReport& s) { return double(s.cavities.size()); }},
                    {"genus", true, "handles of all pieces", false,
                     [](const Mesh&, const SurfaceReport& s) {
                         return double(s.meshComponents) - 0.5 * double(s.meshEulerCharacteristic);
                     }},
                    {"min-angle", true, "degrees as the least angle", true,
                     [](const Mesh& mesh, const SurfaceReport&) { return leastAngle(mesh); }}};

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
