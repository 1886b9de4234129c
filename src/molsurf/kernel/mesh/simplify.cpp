// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/simplify.h"

#include "molsurf/kernel/core/cancel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

using Triangle = std::array<std::uint32_t, 3>;

struct Edge {
    float square; // of its length [Å^2]
    std::uint32_t ends[2];

    bool operator<(const Edge& o) const // the queue's first is its largest
    {
        return std::tie(square, ends[0], ends[1]) > std::tie(o.square, o.ends[0], o.ends[1]);
    }
};

class Thinner
{
public:
    /// Queues all edges, the shortest first.
    explicit Thinner(const Mesh& mesh)
        : mesh_(mesh), triangles_(mesh.triangles), alive_(mesh.positions.size(), 1),
          refused_(mesh.positions.size(), 0), left_(mesh.positions.size()),
          at_(mesh.positions.size())
    {
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for (const std::uint32_t v : triangles_[t]) at_[v].push_back(t);
        for (const Triangle& t : triangles_) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3];
                if (a < b) push(a, b); // its other triangle runs through it from b to a
            }
        }
    }

    /// Removes one end of an edge after another until so many vertices are left.
    void run(std::size_t wanted, const Progress& progress)
    {
        for (std::size_t n = 0; left_ > wanted && !queue_.empty(); ++n) {
            if (n % 4096 == 0) stopIfCancelled(progress);
            const Edge edge = queue_.top();
            queue_.pop();
            const auto [a, b] = edge.ends;
            if (!alive_[a] || !alive_[b]) continue;
            neighbours(a, ofA_);
            if (!std::binary_search(ofA_.begin(), ofA_.end(), b)) continue;
            neighbours(b, ofB_);
            const double byA = keepsTopology() ? worstWithout(a, b) : 0.0;
            const double byB = keepsTopology() ? worstWithout(b, a) : 0.0;
            if (std::max(byA, byB) > 0.0) {
                if (byA >= byB)
                    remove(a, b, ofB_);
                else
                    remove(b, a, ofA_);
            } else {
                refused_[a] = refused_[b] = 1;
            }
        }
    }

    ThinnedMesh result() const
    {
        ThinnedMesh out;
        std::vector<std::uint32_t> number(alive_.size(), 0);
        for (std::uint32_t v = 0; v < alive_.size(); ++v) {
            if (!alive_[v]) continue;
            number[v] = std::uint32_t(out.vertices.size());
            out.vertices.push_back(v);
        }
        for (const Triangle& t : triangles_)
            if (t[0] != t[1]) out.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
        return out;
    }

private:
    Vec3d position(std::uint32_t v) const { return Vec3d(mesh_.positions[v]); }

    void push(std::uint32_t a, std::uint32_t b)
    {
        const auto square = float((position(a) - position(b)).lengthSqr());
        queue_.push({square, {std::min(a, b), std::max(a, b)}});
    }

    /// In ascending order.
    void neighbours(std::uint32_t v, std::vector<std::uint32_t>& out) const
    {
        out.clear();
        for (const std::uint32_t t : at_[v])
            for (const std::uint32_t w : triangles_[t])
                if (w != v) out.push_back(w);
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
    }

    /// Whether an edge may go: its ends have two neighbours in common, those of its triangles, and
    /// are not two corners of a tetrahedron.
    bool keepsTopology() const
    {
        std::size_t common = 0;
        for (const std::uint32_t w : ofA_)
            common += std::binary_search(ofB_.begin(), ofB_.end(), w);
        return common == 2 && ofA_.size() + ofB_.size() > 6;
    }

    /// The worst shape of the triangles that change if `from` goes to `to`: 4 sqrt(3) times the
    /// area over the sum of squared sides, 1 for equal sides; 0 if one must not be made.
    double worstWithout(std::uint32_t from, std::uint32_t to) const
    {
        constexpr double steepest = 0.2; // cosine of the largest turn of a triangle
        constexpr double needle = 0.1;
        double worst = std::numeric_limits<double>::max();
        for (const std::uint32_t t : at_[from]) {
            Triangle corners = triangles_[t];
            if (std::find(corners.begin(), corners.end(), to) != corners.end()) continue;
            const Vec3d before = normal(corners);
            std::replace(corners.begin(), corners.end(), from, to);
            const Vec3d after = normal(corners);
            const double length = after.length();
            if (before.dot(after) <= steepest * before.length() * length) return 0.0;
            for (const std::uint32_t v : corners)
                if (after.dot(Vec3d(mesh_.normals[v])) <= steepest * length) return 0.0;
            double squares = 0.0;
            for (int k = 0; k < 3; ++k)
                squares += (position(corners[k]) - position(corners[(k + 1) % 3])).lengthSqr();
            worst = std::min(worst, 2.0 * std::sqrt(3.0) * length / squares);
        }
        return worst < needle ? 0.0 : worst;
    }

    /// Twice the area, as a vector.
    Vec3d normal(const Triangle& t) const
    {
        const Vec3d first = position(t[0]);
        return (position(t[1]) - first).cross(position(t[2]) - first);
    }

    /// @param[in] before  the neighbours of `to`
    void remove(std::uint32_t from, std::uint32_t to, const std::vector<std::uint32_t>& before)
    {
        for (const std::uint32_t t : at_[from]) {
            Triangle& corners = triangles_[t];
            if (std::find(corners.begin(), corners.end(), to) == corners.end()) {
                std::replace(corners.begin(), corners.end(), from, to);
                at_[to].push_back(t);
                continue;
            }
            for (const std::uint32_t v : corners) {
                if (v == from) continue;
                at_[v].erase(std::find(at_[v].begin(), at_[v].end(), t));
            }
            corners = {0, 0, 0};
        }
        at_[from] = {};
        alive_[from] = 0;
        --left_;
        // New edges, and those that may have been refused in other surroundings.
        neighbours(to, after_);
        for (const std::uint32_t w : after_) {
            if (refused_[to] || refused_[w] || !std::binary_search(before.begin(), before.end(), w))
                push(to, w);
        }
    }

    const Mesh& mesh_;
    std::vector<Triangle> triangles_;   // three equal corners: it is gone
    std::vector<char> alive_, refused_; // refused: an edge there was left
    std::size_t left_;
    std::vector<std::vector<std::uint32_t>> at_; // the triangles at each vertex
    std::priority_queue<Edge> queue_;
    std::vector<std::uint32_t> ofA_, ofB_, after_;
};

} // namespace

ThinnedMesh thinned(const Mesh& mesh, std::size_t wanted, const Progress& progress)
{
    Thinner thinner(mesh);
    thinner.run(wanted, progress);
    return thinner.result();
}

} // namespace molsurf
