// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_border.h"

#include "molsurf/mesh/mesh_instance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// A line of the border with one neighbour: between two corners, or closed without any.
struct Line {
    std::int32_t owner;                  ///< beyond it
    std::vector<std::uint32_t> vertices; ///< in order; of a closed line the first comes last, too
    std::size_t from = none, to = none;  ///< corners
    std::size_t partner = none;          ///< the line that meets it, in the neighbour's frame
    std::size_t loop = none, first = 0;  ///< where its first edge is in the loops
    double length = 0.0;                 ///< [Å]

    bool closed() const { return from == none; }
};

/// A vertex of the border where three owners meet, or as many as an axis has turns.
struct Corner {
    std::uint32_t vertex;
    std::int32_t in, out;    ///< owners beyond the lines that end and begin there
    int owners = 3;          ///< number of owners that meet there, the unit counted
    std::size_t ofIn = none; ///< the corner that the owner `in` has there
    std::size_t ofOut = none;
};

/// A point of a line with its normal.
struct Station {
    Vec3d x, n;
};

class BorderFitter
{
public:
    BorderFitter(const std::vector<Instance>& motions, const SymmetricUnit& unit, double voxel,
                 CutMesh& part)
        : motions_(motions), unit_(unit), near_(2.0 * voxel), close_(0.5 * voxel), part_(part),
          mesh_(part.mesh)
    {
    }

    BorderFit fit()
    {
        do {
            lines_.clear();
            corners_.clear();
            takeLines();
            splitOnAxes();
            matchCorners();
            pairLines();
        } while (dropSlivers());
        moveCorners();
        for (std::size_t l = 0; l < lines_.size(); ++l) {
            if (lines_[l].partner != none && lines_[l].partner > l)
                join(lines_[l], lines_[lines_[l].partner]);
        }
        capLines();
        insertVertices();
        return std::move(out_);
    }

private:
    Vec3d at(std::uint32_t v) const { return Vec3d(mesh_.positions[v]); }
    std::int32_t inverse(std::int32_t g) const
    {
        return std::int32_t(unit_.inverse[std::size_t(g)]);
    }
    std::int32_t product(std::int32_t g, std::int32_t h) const
    {
        return std::int32_t(unit_.product[std::size_t(g)][std::size_t(h)]);
    }
    MeshInstance motion(std::int32_t g) const
    {
        const Instance& m = motions_[std::size_t(g)];
        return {0, {}, m.rotation, m.translation, {}};
    }

    double lengthOf(const std::vector<std::uint32_t>& vertices) const
    {
        double sum = 0.0;
        for (std::size_t i = 1; i < vertices.size(); ++i)
            sum += (at(vertices[i]) - at(vertices[i - 1])).length();
        return sum;
    }

    void takeLines()
    {
        for (const BorderLoop& loop : part_.loops) {
            const std::size_t n = loop.vertices.size();
            std::vector<std::size_t> corners; // places in the loop
            for (std::size_t i = 0; i < n; ++i)
                if (loop.owners[(i + n - 1) % n] != loop.owners[i]) corners.push_back(i);
            if (corners.empty()) corners = onAxis(loop);
            if (corners.empty()) {
                Line& line = lines_.emplace_back();
                line.owner = loop.owners[0];
                line.vertices = loop.vertices;
                line.vertices.push_back(loop.vertices[0]);
                line.length = lengthOf(line.vertices);
                continue;
            }
            const std::size_t first = corners_.size();
            for (const std::size_t i : corners)
                corners_.push_back(
                    {loop.vertices[i], loop.owners[(i + n - 1) % n], loop.owners[i]});
            for (std::size_t c = 0; c < corners.size(); ++c) {
                Line& line = lines_.emplace_back();
                const std::size_t d = (c + 1) % corners.size();
                line.owner = loop.owners[corners[c]];
                line.from = first + c;
                line.to = first + d;
                for (std::size_t i = corners[c];; i = (i + 1) % n) {
                    if (i == corners[d] && !line.vertices.empty()) break;
                    line.vertices.push_back(loop.vertices[i]);
                }
                line.vertices.push_back(loop.vertices[corners[d]]);
                line.loop = std::size_t(&loop - part_.loops.data());
                line.first = corners[c];
                line.length = lengthOf(line.vertices);
                lineFrom_[first + c] = lines_.size() - 1;
                lineTo_[first + d] = lines_.size() - 1;
            }
        }
    }

    /// The two places where a loop that a two-fold rotation takes onto itself crosses the axis;
    /// nothing if it is no such loop.
    std::vector<std::size_t> onAxis(const BorderLoop& loop) const
    {
        const std::int32_t g = loop.owners[0];
        const std::size_t n = loop.vertices.size();
        if (g < 0 || product(g, g) != 0 || n < 4) return {};
        const MeshInstance turn = motion(g);
        const auto moves = [&](std::size_t i) {
            const Vec3d x = at(loop.vertices[i % n]);
            return (turn.placed(x) - x).length();
        };
        std::size_t first = 0;
        for (std::size_t i = 1; i < n; ++i)
            if (moves(i) < moves(first)) first = i;
        std::size_t second = first + n / 4;
        for (std::size_t i = second; i <= first + n - n / 4; ++i)
            if (moves(i) < moves(second)) second = i;
        if (moves(first) > near_ || moves(second) > near_) return {};
        std::vector<std::size_t> places = {first, second % n};
        std::sort(places.begin(), places.end());
        return places;
    }

    /// Splits lines that a two-fold rotation takes onto themselves where they cross its axis, by a
    /// corner of two owners.
    void splitOnAxes()
    {
        const std::size_t count = lines_.size();
        for (std::size_t l = 0; l < count; ++l) {
            const Line& line = lines_[l];
            const std::int32_t g = line.owner;
            if (g < 0 || line.closed() || product(g, g) != 0) continue;
            const Corner &from = corners_[line.from], &to = corners_[line.to];
            if (from.in == g || to.out == g) continue; // a loop that was split already
            const MeshInstance turn = motion(g);
            if ((turn.placed(at(from.vertex)) - at(to.vertex)).length() > near_) continue;
            std::size_t best = 0;
            double least = near_;
            for (std::size_t i = 1; i + 1 < line.vertices.size(); ++i) {
                const Vec3d x = at(line.vertices[i]);
                const double moves = (turn.placed(x) - x).length();
                if (moves > least) continue;
                least = moves;
                best = i;
            }
            if (best == 0) continue;
            const std::size_t corner = corners_.size();
            corners_.push_back({line.vertices[best], g, g});
            Line rest = line;
            rest.vertices.erase(rest.vertices.begin(),
                                rest.vertices.begin() + std::ptrdiff_t(best));
            rest.from = corner;
            rest.length = lengthOf(rest.vertices);
            lineTo_[line.to] = lines_.size();
            lineFrom_[corner] = lines_.size();
            lineTo_[corner] = l;
            lines_[l].vertices.resize(best + 1);
            lines_[l].length = lengthOf(lines_[l].vertices);
            lines_[l].to = corner;
            lines_.push_back(std::move(rest));
        }
    }

    /// The order of a rotation.
    int turns(std::int32_t g) const
    {
        int k = 1;
        for (std::int32_t power = g; power != 0; power = product(g, power)) ++k;
        return k;
    }

    /// The corner with these owners that is nearest to a point.
    std::size_t nearest(const Vec3d& x, std::int32_t in, std::int32_t out) const
    {
        std::size_t best = none;
        double least = near_;
        const auto found = cornersOf_.find({in, out});
        if (found == cornersOf_.end()) return none;
        for (const std::size_t c : found->second) {
            const double distance = (at(corners_[c].vertex) - x).length();
            if (distance > least) continue;
            least = distance;
            best = c;
        }
        return best;
    }

    void matchCorners()
    {
        cornersOf_.clear();
        for (std::size_t c = 0; c < corners_.size(); ++c)
            cornersOf_[{corners_[c].in, corners_[c].out}].push_back(c);
        for (std::size_t c = 0; c < corners_.size(); ++c) {
            Corner& corner = corners_[c];
            const std::int32_t g = corner.in, h = corner.out;
            if (g < 0 || h < 0) continue;
            const Vec3d x = at(corner.vertex);
            const Vec3d byIn = motion(inverse(g)).placed(x), byOut = motion(inverse(h)).placed(x);
            if (product(g, h) == 0 && turns(g) != 3 && (byIn - x).length() < near_) {
                corner.owners = turns(g);
                corner.ofIn = corner.ofOut = c;
                continue;
            }
            corner.ofIn = nearest(byIn, product(inverse(g), h), inverse(g));
            corner.ofOut = nearest(byOut, inverse(h), product(inverse(h), g));
        }
    }

    /// Gives short lines that no neighbour knows of to the owner before and after them.
    /// @return whether there were any
    bool dropSlivers()
    {
        const double tiny = 0.025 * near_, small = 1.5 * near_;
        const auto unknown = [&](std::size_t c) {
            return corners_[c].ofIn == none && corners_[c].ofOut == none;
        };
        for (const Line& line : lines_) {
            if (line.closed() || line.partner != none || line.length > small) continue;
            if (line.length > tiny && !(unknown(line.from) && unknown(line.to))) continue;
            BorderLoop& loop = part_.loops[line.loop];
            const std::size_t n = loop.owners.size();
            const std::int32_t before = loop.owners[(line.first + n - 1) % n];
            const std::size_t edges = line.vertices.size() - 1;
            const std::int32_t after = loop.owners[(line.first + edges) % n];
            if (before == line.owner || (before != after && line.length > tiny)) continue;
            for (std::size_t i = 0; i < edges; ++i) loop.owners[(line.first + i) % n] = before;
            return true;
        }
        return false;
    }

    /// Corners that meet move to the middle of where they were.
    void moveCorners()
    {
        std::vector<Station> middles;
        for (const Corner& corner : corners_) {
            Station sum{at(corner.vertex), Vec3d(mesh_.normals[corner.vertex])};
            if (corner.owners != 3) {
                // All turns about the axis.
                Station mean{Vec3d(0.0), Vec3d(0.0)};
                std::int32_t power = 0;
                for (int k = 0; k < corner.owners; ++k) {
                    mean.x += motion(power).placed(sum.x) / double(corner.owners);
                    mean.n += motion(power).turned(sum.n);
                    power = product(corner.in, power);
                }
                sum = mean;
            } else if (corner.ofIn != none && corner.ofOut != none) {
                for (const auto& [g, other] :
                     {std::pair(corner.in, corner.ofIn), std::pair(corner.out, corner.ofOut)}) {
                    const std::uint32_t v = corners_[other].vertex;
                    sum.x += motion(g).placed(at(v));
                    sum.n += motion(g).turned(Vec3d(mesh_.normals[v]));
                }
                sum.x /= 3.0;
            }
            middles.push_back(sum);
        }
        for (std::size_t c = 0; c < corners_.size(); ++c) move(corners_[c].vertex, middles[c]);
    }

    void move(std::uint32_t v, const Station& to)
    {
        out_.largest = std::max(out_.largest, 2.0 * (to.x - at(v)).length());
        mesh_.positions[v] = Vec3f(to.x);
        if (to.n.lengthSqr() > 0.0) mesh_.normals[v] = Vec3f(to.n.unit());
    }

    void pairLines()
    {
        for (std::size_t l = 0; l < lines_.size(); ++l) {
            Line& line = lines_[l];
            if (line.owner < 0 || line.closed()) continue;
            const std::size_t begin = corners_[line.to].ofIn, end = corners_[line.from].ofOut;
            if (begin == none || end == none) continue;
            const std::size_t partner = lineFrom_.at(begin);
            if (lines_[partner].to == end && lines_[partner].owner == inverse(line.owner))
                line.partner = partner;
        }
        for (std::size_t l = 0; l < lines_.size(); ++l) {
            Line& line = lines_[l];
            if (line.owner < 0 || !line.closed()) continue;
            const MeshInstance back = motion(inverse(line.owner));
            double least = near_;
            for (std::size_t k = 0; k < lines_.size(); ++k) {
                const Line& other = lines_[k];
                if (k == l || !other.closed() || other.owner != inverse(line.owner)) continue;
                double farthest = 0.0; // of some vertices, to those of the other line
                const std::size_t step = std::max<std::size_t>(1, line.vertices.size() / 8);
                for (std::size_t i = 0; i < line.vertices.size(); i += step) {
                    const Vec3d x = back.placed(at(line.vertices[i]));
                    double distance = std::numeric_limits<double>::max();
                    for (const std::uint32_t v : other.vertices)
                        distance = std::min(distance, (at(v) - x).length());
                    farthest = std::max(farthest, distance);
                }
                if (farthest > least) continue;
                least = farthest;
                line.partner = k;
            }
        }
        for (std::size_t l = 0; l < lines_.size(); ++l) { // both ways
            const std::size_t partner = lines_[l].partner;
            if (partner != none && lines_[partner].partner != l) lines_[l].partner = none;
        }
    }

    /// Where the vertices of a line lie along another one that runs beside it, in numbers of its
    /// vertices: ascending. Dynamic time warping (Sakoe and Chiba, IEEE Trans. Acoust. Speech
    /// Signal Process. 26:43-49, 1978) finds which vertices belong together; between them the
    /// nearest points count.
    static std::vector<double> placesOn(const std::vector<Vec3d>& line,
                                        const std::vector<Vec3d>& along)
    {
        const std::size_t n = line.size(), m = along.size();
        // Lines have about as many vertices a length, so that the best way is near the diagonal.
        const std::size_t band = 64 + std::max(n, m) / 10;
        const auto low = [&](std::size_t i) {
            const std::size_t middle = i * (m - 1) / (n - 1);
            return middle > band ? middle - band : 0;
        };
        const std::size_t width = 2 * band + 1;
        std::vector<float> cost(n * width, std::numeric_limits<float>::max());
        std::vector<std::uint8_t> from(n * width, 0); // 1: line, 2: along, 3: both
        const auto costAt = [&](std::size_t i, std::size_t j) {
            const std::size_t first = low(i);
            return j < first || j - first >= width ? std::numeric_limits<float>::max()
                                                   : cost[i * width + j - first];
        };
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = low(i); j < std::min(m, low(i) + width); ++j) {
                float least = i + j == 0 ? 0.0f : std::numeric_limits<float>::max();
                std::uint8_t way = 0;
                if (i > 0 && j > 0 && costAt(i - 1, j - 1) < least) {
                    least = costAt(i - 1, j - 1);
                    way = 3;
                }
                if (i > 0 && costAt(i - 1, j) < least) {
                    least = costAt(i - 1, j);
                    way = 1;
                }
                if (j > 0 && costAt(i, j - 1) < least) {
                    least = costAt(i, j - 1);
                    way = 2;
                }
                cost[i * width + j - low(i)] = least + float((line[i] - along[j]).lengthSqr());
                from[i * width + j - low(i)] = way;
            }
        }
        std::vector<std::size_t> first(n, m - 1), last(n, 0); // partners of each vertex
        for (std::size_t i = n - 1, j = m - 1;;) {
            first[i] = std::min(first[i], j);
            last[i] = std::max(last[i], j);
            const std::uint8_t way = from[i * width + j - low(i)];
            if (way == 0) break;
            i -= way & 1;
            j -= way >> 1;
        }
        std::vector<double> out(n);
        double least = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            double best = double(first[i]), distance = std::numeric_limits<double>::max();
            for (std::size_t j = std::max<std::size_t>(first[i], 1) - 1;
                 j < std::min(last[i] + 1, m - 1); ++j) {
                const Vec3d edge = along[j + 1] - along[j];
                const double square = edge.lengthSqr();
                const double w = square > 0.0
                                     ? std::clamp((line[i] - along[j]).dot(edge) / square, 0.0, 1.0)
                                     : 0.5;
                const double d = (along[j] + w * edge - line[i]).lengthSqr();
                if (d >= distance) continue;
                distance = d;
                best = double(j) + w;
            }
            least = std::max(least, best);
            out[i] = least;
        }
        out.front() = 0.0;
        out.back() = double(m - 1);
        return out;
    }

    /// A point of a line. @param[in] t  in numbers of its vertices
    Station station(const Line& line, double t) const
    {
        const std::size_t i = std::min(std::size_t(t), line.vertices.size() - 2);
        const double w = t - double(i);
        const std::uint32_t a = line.vertices[i], b = line.vertices[i + 1];
        return {(1.0 - w) * at(a) + w * at(b),
                (1.0 - w) * Vec3d(mesh_.normals[a]) + w * Vec3d(mesh_.normals[b])};
    }

    /// A vertex of a line, or of its partner turned into its frame, or of both if they are close.
    struct Entry {
        double own, its; ///< places on the line and on the partner, in numbers of vertices
        std::size_t ofOwn = none, ofIts = none; ///< the vertices
    };

    /// Turns a closed line so that it begins where its partner does.
    void alignClosed(Line& line, const Vec3d& start)
    {
        line.vertices.pop_back();
        const auto nearest = std::min_element(
            line.vertices.begin(), line.vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
                return (at(a) - start).lengthSqr() < (at(b) - start).lengthSqr();
            });
        std::rotate(line.vertices.begin(), nearest, line.vertices.end());
        line.vertices.push_back(line.vertices[0]);
    }

    /// Gives two lines that meet the vertices of both, on the mean of both.
    void join(Line& line, Line& partner)
    {
        const MeshInstance back = motion(inverse(line.owner)), there = motion(line.owner);
        if (line.closed()) alignClosed(partner, back.placed(at(line.vertices[0])));
        std::vector<Vec3d> own, its; // points, both in the frame and the order of the line
        for (const std::uint32_t v : line.vertices) own.push_back(at(v));
        for (const std::uint32_t v : partner.vertices) its.push_back(there.placed(at(v)));
        std::reverse(its.begin(), its.end());
        const std::size_t n = own.size(), m = its.size();

        const std::vector<double> placed = placesOn(its, own);
        const auto inverted = [&](double t) { // the place on the partner
            const std::size_t j = std::clamp<std::size_t>(
                std::size_t(std::upper_bound(placed.begin(), placed.end(), t) - placed.begin()), 1,
                m - 1);
            const double width = placed[j] - placed[j - 1];
            return double(j - 1) +
                   (width > 0.0 ? std::clamp((t - placed[j - 1]) / width, 0.0, 1.0) : 0.5);
        };
        std::vector<Entry> entries;
        for (std::size_t i = 1; i + 1 < n; ++i)
            entries.push_back({double(i), inverted(double(i)), i, none});
        for (std::size_t j = 1; j + 1 < m; ++j) entries.push_back({placed[j], double(j), none, j});
        std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
            return a.own != b.own ? a.own < b.own : a.its < b.its;
        });
        combine(entries, own, its);

        std::vector<std::uint32_t> mine = {line.vertices.front()};
        std::vector<std::uint32_t> other = {partner.vertices.back()};
        for (const Entry& e : entries) {
            const double t = double(m - 1) - e.its; // on the partner in its own order
            const Station a = station(line, e.own), b = station(partner, t);
            const Station mean{0.5 * (a.x + there.placed(b.x)), a.n + there.turned(b.n)};
            const Station turned{back.placed(mean.x), back.turned(mean.n)};
            mine.push_back(e.ofOwn != none ? moved(line.vertices[e.ofOwn], mean)
                                           : newVertex(line, e.own, mean));
            other.push_back(e.ofIts != none ? moved(partner.vertices[m - 1 - e.ofIts], turned)
                                            : newVertex(partner, t, turned));
        }
        mine.push_back(line.vertices.back());
        other.push_back(partner.vertices.front());
        if (line.closed()) { // its ends meet as well
            const std::uint32_t a = mine[0], b = other[0];
            const Station mean{0.5 * (at(a) + there.placed(at(b))),
                               Vec3d(mesh_.normals[a]) + there.turned(Vec3d(mesh_.normals[b]))};
            moved(a, mean);
            moved(b, {back.placed(mean.x), back.turned(mean.n)});
        }
        for (std::size_t i = 0; i + (line.closed() ? 1 : 0) < mine.size(); ++i) {
            out_.shared.push_back({mine[i], line.owner, other[i]});
            out_.shared.push_back({other[i], partner.owner, mine[i]});
        }
        recordChain(line, mine);
        recordChain(partner, {other.rbegin(), other.rend()});
    }

    /// A line of a unit of the whole.
    struct UnitLine {
        std::int32_t unit;
        std::size_t line;
    };

    /// The lines without partners that run round a hole of the whole, from one on: each begins
    /// where the one before it ends, if only in a neighbour that shares this corner.
    /// @return nothing if there is no such round
    std::vector<UnitLine> roundFrom(std::size_t start) const
    {
        std::vector<UnitLine> out = {{0, start}};
        if (lines_[start].closed()) return out;
        while (true) {
            const UnitLine last = out.back();
            // The corners of the whole that are the end of the last line.
            std::vector<std::pair<std::int32_t, std::size_t>> same = {
                {last.unit, lines_[last.line].to}};
            for (std::size_t i = 0; i < same.size(); ++i) {
                const std::int32_t unit = same[i].first;
                const std::size_t c = same[i].second;
                const auto add = [&](std::size_t line, std::size_t corner) {
                    const std::pair<std::int32_t, std::size_t> next(
                        product(unit, lines_[line].owner), corner);
                    if (std::find(same.begin(), same.end(), next) == same.end())
                        same.push_back(next);
                };
                const std::size_t in = lineTo_.at(c), from = lineFrom_.at(c);
                if (lines_[in].partner != none) add(in, lines_[lines_[in].partner].from);
                if (lines_[from].partner != none) add(from, lines_[lines_[from].partner].to);
            }
            const auto next = std::find_if(same.begin(), same.end(), [&](const auto& corner) {
                return lines_[lineFrom_.at(corner.second)].partner == none;
            });
            if (next == same.end() || out.size() > 4 * lines_.size()) return {};
            const UnitLine found{next->first, lineFrom_.at(next->second)};
            if (found.unit == 0 && found.line == start) return out;
            out.push_back(found);
        }
    }

    /// Closes the holes that are left where lines fit none of a neighbour's, at gaps and necks too
    /// narrow for the voxels, by triangles about their middles.
    void capLines()
    {
        const double longest = 40.0 * near_; // of a hole [Å]
        std::vector<char> done(lines_.size(), 0);
        for (std::size_t l = 0; l < lines_.size(); ++l) {
            if (lines_[l].partner != none || done[l]) continue;
            const std::vector<UnitLine> round = roundFrom(l);
            double length = 0.0;
            for (const UnitLine& part : round) length += lines_[part.line].length;
            if (round.empty() || length > longest) {
                done[l] = 1;
                out_.open += lines_[l].vertices.size() - 1;
                continue;
            }
            Station middle{Vec3d(0.0), Vec3d(0.0)}; // in the frame of unit 0
            double weight = 0.0;
            const Vec3d origin = at(lines_[l].vertices[0]);
            for (const UnitLine& part : round) {
                const MeshInstance there = motion(part.unit);
                const auto& v = lines_[part.line].vertices;
                for (std::size_t i = 0; i + 1 < v.size(); ++i) {
                    const Vec3d a = there.placed(at(v[i])), b = there.placed(at(v[i + 1]));
                    middle.x += 0.5 * (b - a).length() * (a + b);
                    weight += (b - a).length();
                    middle.n += (b - origin).cross(a - origin);
                }
            }
            middle.x = weight > 0.0 ? middle.x / weight : origin;
            std::map<std::size_t, std::uint32_t> vertexOf; // of a line's triangles: the middle
            for (const UnitLine& part : round) {
                const auto [found, isNew] = vertexOf.emplace(part.line, 0);
                if (isNew) {
                    found->second = middleOf(part, middle);
                    done[part.line] = 1;
                }
                const std::uint32_t first = vertexOf.at(l);
                if (part.unit == 0 && found->second == first) continue;
                out_.shared.push_back({first, part.unit, found->second});
                out_.shared.push_back({found->second, inverse(part.unit), first});
            }
            ++out_.caps;
        }
    }

    /// The middle of a cap in the frame of one of its lines, with the triangles about it.
    std::uint32_t middleOf(const UnitLine& part, const Station& middle)
    {
        const MeshInstance back = motion(inverse(part.unit));
        const auto& v = lines_[part.line].vertices;
        const auto out = std::uint32_t(mesh_.positions.size());
        mesh_.positions.push_back(Vec3f(back.placed(middle.x)));
        mesh_.normals.push_back(middle.n.lengthSqr() > 0.0 ? Vec3f(back.turned(middle.n.unit()))
                                                           : mesh_.normals[v[0]]);
        for (auto& scalar : mesh_.scalars) scalar.values.push_back(scalar.values[v[0]]);
        for (std::size_t i = 0; i + 1 < v.size(); ++i) caps_.push_back({v[i + 1], v[i], out});
        return out;
    }

    std::uint32_t moved(std::uint32_t v, const Station& to)
    {
        pending_.push_back({v, to});
        return v;
    }

    /// Makes one entry of two neighbours that are close, one of each line.
    void combine(std::vector<Entry>& entries, const std::vector<Vec3d>& own,
                 const std::vector<Vec3d>& its) const
    {
        std::vector<Entry> kept;
        for (const Entry& e : entries) {
            Entry* last = kept.empty() ? nullptr : &kept.back();
            const bool pair = last && (last->ofOwn == none) != (last->ofIts == none) &&
                              (last->ofOwn == none) == (e.ofOwn != none);
            if (pair) {
                const Vec3d& a = own[e.ofOwn != none ? e.ofOwn : last->ofOwn];
                const Vec3d& b = its[e.ofIts != none ? e.ofIts : last->ofIts];
                if ((a - b).length() < close_) {
                    if (e.ofOwn != none) {
                        last->own = e.own;
                        last->ofOwn = e.ofOwn;
                    } else {
                        last->its = e.its;
                        last->ofIts = e.ofIts;
                    }
                    continue;
                }
            }
            kept.push_back(e);
        }
        entries = std::move(kept);
    }

    /// @param[in] t  its place on the line
    std::uint32_t newVertex(const Line& line, double t, const Station& to)
    {
        const auto v = std::uint32_t(mesh_.positions.size());
        const std::size_t i = std::min(std::size_t(t), line.vertices.size() - 2);
        const float w = float(t - double(i));
        const std::uint32_t a = line.vertices[i], b = line.vertices[i + 1];
        mesh_.positions.push_back(Vec3f(to.x));
        mesh_.normals.push_back(to.n.lengthSqr() > 0.0 ? Vec3f(to.n.unit()) : mesh_.normals[a]);
        for (auto& scalar : mesh_.scalars)
            scalar.values.push_back((1.0f - w) * scalar.values[a] + w * scalar.values[b]);
        return v;
    }

    /// Notes between which old vertices of a line new ones stand.
    void recordChain(const Line& line, const std::vector<std::uint32_t>& chain)
    {
        std::size_t old = 0;
        for (const std::uint32_t v : chain) {
            if (old < line.vertices.size() && v == line.vertices[old]) {
                ++old;
            } else {
                between_[{line.vertices[old - 1], line.vertices[old]}].push_back(v);
            }
        }
    }

    void insertVertices()
    {
        for (const auto& [v, to] : pending_) move(v, to);
        const std::size_t count = mesh_.triangles.size();
        for (std::size_t i = 0; i < count; ++i) {
            for (int k = 0; k < 3; ++k) {
                const auto t = mesh_.triangles[i];
                const std::uint32_t a = t[std::size_t(k)], b = t[std::size_t((k + 1) % 3)],
                                    c = t[std::size_t((k + 2) % 3)];
                const auto found = between_.find({a, b});
                if (found == between_.end()) continue;
                std::uint32_t last = a;
                for (const std::uint32_t v : found->second) {
                    mesh_.triangles.push_back({last, v, c});
                    last = v;
                }
                mesh_.triangles[i] = {last, b, c};
                break;
            }
        }
        mesh_.triangles.insert(mesh_.triangles.end(), caps_.begin(), caps_.end());
    }

    const std::vector<Instance>& motions_;
    const SymmetricUnit& unit_;
    const double near_, close_; ///< [Å]
    CutMesh& part_;
    Mesh& mesh_;
    BorderFit out_;
    std::vector<Line> lines_;
    std::vector<Corner> corners_;
    std::map<std::size_t, std::size_t> lineFrom_, lineTo_; ///< of corners
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> cornersOf_;
    std::vector<std::pair<std::uint32_t, Station>> pending_; ///< vertices that move at last
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> between_;
    std::vector<std::array<std::uint32_t, 3>> caps_;
};

} // namespace

BorderClasses::BorderClasses(const SymmetricUnit& unit, const std::vector<SharedVertex>& shared,
                             std::size_t vertices)
    : order_(unit.inverse.size()), border_([&] {
          std::vector<std::uint32_t> all;
          for (const SharedVertex& s : shared) all.push_back(s.vertex);
          std::sort(all.begin(), all.end());
          all.erase(std::unique(all.begin(), all.end()), all.end());
          return all;
      }()),
      place_(vertices, -1), sets_(order_ * border_.size())
{
    const std::size_t n = border_.size();
    for (std::size_t i = 0; i < n; ++i) place_[border_[i]] = std::int32_t(i);
    for (const SharedVertex& s : shared) {
        const auto from = std::size_t(place_[s.vertex]), to = std::size_t(place_[s.other]);
        for (std::size_t k = 0; k < order_; ++k)
            sets_.join(std::uint32_t(k * n + from),
                       std::uint32_t(unit.product[k][std::size_t(s.motion)] * n + to));
    }
}

std::size_t BorderClasses::count()
{
    std::size_t out = 0;
    for (std::size_t i = 0; i < order_ * border_.size(); ++i)
        out += sets_.find(std::uint32_t(i)) == i;
    return out;
}

BorderFit fitBorder(const std::vector<Instance>& motions, const SymmetricUnit& unit, double voxel,
                    CutMesh& part)
{
    return BorderFitter(motions, unit, voxel, part).fit();
}

} // namespace molsurf
