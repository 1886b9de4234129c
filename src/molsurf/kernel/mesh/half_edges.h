// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The edges of a closed manifold mesh of triangles, and the changes of them that keep it so.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// The triangles of a closed manifold mesh by their half-edges: 3 t + k runs from corner k of
/// triangle t to the next corner, and its twin runs the other way in the triangle beside. flip(),
/// split() and collapse() keep the mesh a closed manifold of the same Euler number. In their code h
/// runs from a to b in (a, b, c), its twin g from b to a in (b, a, d); bc is the twin of the
/// half-edge from b to c, and so on.
class HalfEdges
{
public:
    using Id = std::uint32_t;

    /// @pre the triangles are a closed, oriented manifold
    HalfEdges(std::vector<std::array<std::uint32_t, 3>> triangles, std::size_t vertices);

    static Id next(Id h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static Id previous(Id h) { return h % 3 == 0 ? h + 2 : h - 1; }
    Id twin(Id h) const { return twins_[h]; }
    std::uint32_t from(Id h) const { return triangles_[h / 3][h % 3]; }
    std::uint32_t to(Id h) const { return from(next(h)); }
    std::uint32_t opposite(Id h) const { return from(previous(h)); } ///< third corner
    int valence(std::uint32_t v) const { return valences_[v]; }      ///< 0: the vertex is gone
    bool isGone(std::size_t t) const { return triangles_[t][0] == triangles_[t][1]; }

    const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
    std::size_t vertices() const { return valences_.size(); }

    /// Calls f(h) for the half-edges from a vertex, around it.
    template<typename F>
    void around(std::uint32_t v, const F& f) const
    {
        const Id first = outgoing_[v];
        Id h = first;
        do {
            f(h);
            h = twins_[previous(h)];
        } while (h != first);
    }

    /// The half-edge from one vertex to another; `none` if they are no neighbours.
    Id between(std::uint32_t a, std::uint32_t b) const;
    static constexpr Id none = ~Id(0);

    /// Whether an edge may turn: its triangles keep three corners, and no second edge arises
    /// between two vertices.
    bool canFlip(Id h) const;
    /// Turns an edge to the other diagonal of its two triangles.
    void flip(Id h);

    /// Puts a vertex on an edge.
    /// @param[in] v  a new one: vertices()
    void split(Id h, std::uint32_t v);

    /// Whether the ends of an edge may become one vertex: the link condition, that its two
    /// triangles have all common neighbours, and the mesh is no tetrahedron.
    bool canCollapse(Id h) const;
    /// Moves from(h) to to(h): two triangles and a vertex go.
    void collapse(Id h);

private:
    void glue(Id a, Id b)
    {
        twins_[a] = b;
        twins_[b] = a;
    }

    std::vector<std::array<std::uint32_t, 3>> triangles_; // two equal corners: it is gone
    std::vector<Id> twins_, outgoing_;
    std::vector<std::uint16_t> valences_;
    std::vector<std::uint32_t> free_; // triangles that are gone
};

} // namespace molsurf
