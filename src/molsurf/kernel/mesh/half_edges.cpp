// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/half_edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace molsurf
{

HalfEdges::HalfEdges(std::vector<std::array<std::uint32_t, 3>> triangles, std::size_t vertices)
    : triangles_(std::move(triangles)), twins_(3 * triangles_.size(), none),
      outgoing_(vertices, none), valences_(vertices, 0)
{
    for (Id h = 0; h < twins_.size(); ++h) {
        ++valences_[from(h)];
        if (outgoing_[from(h)] == none) outgoing_[from(h)] = h;
    }
    // Half-edges by the vertex that they come from.
    std::vector<Id> begins(vertices + 1, 0), leaving(twins_.size());
    for (std::size_t v = 0; v < vertices; ++v) begins[v + 1] = begins[v] + valences_[v];
    std::vector<Id> place(begins.begin(), begins.end() - 1);
    for (Id h = 0; h < twins_.size(); ++h) leaving[place[from(h)]++] = h;
    for (Id h = 0; h < twins_.size(); ++h) {
        const std::uint32_t a = from(h), b = to(h);
        if (a > b) continue;
        for (Id i = begins[b]; i < begins[b + 1]; ++i)
            if (to(leaving[i]) == a) glue(h, leaving[i]);
    }
}

HalfEdges::Id HalfEdges::between(std::uint32_t a, std::uint32_t b) const
{
    Id found = none;
    around(a, [&](Id h) {
        if (to(h) == b) found = h;
    });
    return found;
}

bool HalfEdges::canFlip(Id h) const
{
    const std::uint32_t a = from(h), b = to(h), c = opposite(h), d = opposite(twins_[h]);
    if (c == d || valences_[a] <= 3 || valences_[b] <= 3) return false;
    return (valences_[c] < valences_[d] ? between(c, d) : between(d, c)) == none;
}

void HalfEdges::flip(Id h)
{
    const Id g = twins_[h], hn = next(h), hp = previous(h), gn = next(g), gp = previous(g);
    const std::uint32_t a = from(h), b = from(g), c = from(hp), d = from(gp);
    const Id ca = twins_[hp], ad = twins_[gn], db = twins_[gp], bc = twins_[hn];
    // h: d -> c, then c -> a and a -> d; g: c -> d, then d -> b and b -> c.
    triangles_[h / 3][h % 3] = d;
    triangles_[h / 3][hn % 3] = c;
    triangles_[h / 3][hp % 3] = a;
    triangles_[g / 3][g % 3] = c;
    triangles_[g / 3][gn % 3] = d;
    triangles_[g / 3][gp % 3] = b;
    glue(hn, ca);
    glue(hp, ad);
    glue(gn, db);
    glue(gp, bc);
    outgoing_[a] = hp;
    outgoing_[b] = gp;
    outgoing_[c] = hn;
    outgoing_[d] = gn;
    --valences_[a];
    --valences_[b];
    ++valences_[c];
    ++valences_[d];
}

void HalfEdges::split(Id h, std::uint32_t v)
{
    const auto made = [this] {
        if (!free_.empty()) {
            const std::uint32_t t = free_.back();
            free_.pop_back();
            return t;
        }
        triangles_.push_back({});
        twins_.resize(twins_.size() + 3, none);
        return std::uint32_t(triangles_.size() - 1);
    };
    const std::uint32_t t = made(), u = made();
    const Id g = twins_[h], hn = next(h), gp = previous(g);
    const std::uint32_t b = from(g), c = opposite(h), d = opposite(g);
    const Id bc = twins_[hn], db = twins_[gp];
    triangles_[h / 3][hn % 3] = v; // a v c
    triangles_[g / 3][g % 3] = v;  // v a d
    triangles_[t] = {v, b, c};
    triangles_[u] = {b, v, d};
    glue(3 * t, 3 * u);
    glue(3 * t + 1, bc);
    glue(3 * t + 2, hn);
    glue(3 * u + 1, gp);
    glue(3 * u + 2, db);
    outgoing_.resize(std::size_t(v) + 1);
    valences_.resize(std::size_t(v) + 1);
    outgoing_[v] = 3 * t;
    outgoing_[b] = 3 * t + 1;
    valences_[v] = 4;
    ++valences_[c];
    ++valences_[d];
}

bool HalfEdges::canCollapse(Id h) const
{
    const std::uint32_t a = from(h), b = to(h);
    if (valences_[a] + valences_[b] <= 6) return false;
    int common = 0;
    around(a, [&](Id i) {
        const std::uint32_t w = to(i);
        around(b, [&](Id j) { common += to(j) == w; });
    });
    return common == 2;
}

void HalfEdges::collapse(Id h)
{
    const Id g = twins_[h];
    const std::uint32_t a = from(h), b = to(h), c = opposite(h), d = opposite(g);
    const Id bc = twins_[next(h)], ca = twins_[previous(h)];
    const Id ad = twins_[next(g)], db = twins_[previous(g)];
    std::vector<Id> leaving;
    leaving.reserve(valences_[a]);
    around(a, [&](Id i) { leaving.push_back(i); });
    for (const Id i : leaving) triangles_[i / 3][i % 3] = b;
    glue(bc, ca); // c -> b and, now, b -> c
    glue(ad, db);
    outgoing_[b] = ca;
    outgoing_[c] = bc;
    outgoing_[d] = ad;
    valences_[b] = std::uint16_t(valences_[a] + valences_[b] - 4);
    valences_[a] = 0;
    --valences_[c];
    --valences_[d];
    for (const Id i : {h, g}) {
        triangles_[i / 3] = {};
        free_.push_back(i / 3);
    }
}

} // namespace molsurf
