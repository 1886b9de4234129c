// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The smooth field of a molecule, psi(x) = ln sum_i exp(-C_i (|x - x_i|^2 - R_i^2)), with R_i =
/// r_i plus the probe radius and C_i = ln 2 / (eps R_i). psi = 0 approximates the
/// solvent-accessible surface from outside to within about eps; psi > 0 inside. The paper's g is 1
/// - e^psi: psi is kept instead since it is nearly quadratic, and g spans many decades
/// (docs/math.md, section 2).

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/levelset/bumps.h"
#include "molsurf/kernel/levelset/gaussian_terms.h"
#include "molsurf/kernel/levelset/jet_terms.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace molsurf
{

/// How far the Gaussians of balls reach: psi near a leaf depends on it and on the balls near it.
struct GaussianExtent {
    double maxRadius;      ///< largest r_i [Å]
    double maxGrownRadius; ///< largest R_i, grown by the level of its Gaussian [Å]
    double maxTolerance;   ///< largest tolerance of all balls [Å]

    /// How far from a leaf the balls may lie whose terms count there [Å].
    /// @param[in] reach  how far outside the balls of radius R_i psi is wanted [Å]
    double cutoff(double reach) const;

    /// How far psi = 0 may lie from the centres of balls, even where they are crowded [Å].
    double ofZero() const { return maxGrownRadius + 3.0 * maxTolerance; }
};

/// Parameters of psi.
struct GaussianOptions {
    double probe = 1.4;      ///< probe radius r_b [Å]
    double epsilon = 0.5;    ///< tolerance eps [Å]; not used with a blobbiness
    double blobbiness = 0.0; ///< d > 0: C_i = d / R_i^2 instead, the Gaussian surface of Blinn
    double voxelSize = 0.5;  ///< edge h of a voxel [Å]
    double reach = 3.0;      ///< how far outside the balls of radius R_i psi is wanted [Å]
    /// Of all balls, where the sum is made of some: near these it is then the same.
    std::optional<GaussianExtent> extent{};

    /// C of a ball of radius R_i without a rate of its own [1/Å^2].
    double rate(double R) const
    {
        return blobbiness > 0.0 ? blobbiness / (R * R) : M_LN2 / (epsilon * R);
    }
};

/// Finds how far the Gaussians of balls reach.
/// @param[in] decays  one a ball, or none
GaussianExtent extentOf(const std::vector<Ball>& balls, const GaussianOptions& options,
                        const std::vector<Decay>& decays);

/// psi of a set of balls, evaluated leaf by leaf.
class GaussianSum
{
public:
    /// @param[in] decays  one a ball, or none: all by the options
    GaussianSum(const std::vector<Ball>& balls, const GaussianOptions& options,
                const std::vector<Decay>& decays = {});

    /// How far psi = 0 may lie outside the balls of radius R_i, as a length for each doubling of
    /// the balls that meet there: the largest tolerance of all balls [Å].
    double tolerance() const { return extent_.maxTolerance; }

    /// GaussianOptions::epsilon
    double epsilon() const { return options_.epsilon; }

    /// How far a point lies outside all balls of radius R_i, at most `most`; negative inside one
    /// [Å].
    double roomAt(const openvdb::Vec3d& x, double most = 3.0) const;

    /// Whether a point lies in a ball of radius R_i, and so far within its rim [Å].
    bool isCovered(const openvdb::Vec3d& x, double more) const;

    using BumpsFor = std::function<Bumps(const SparseField& psi)>;

    /// psi on the voxels within `steps` voxels (see dilated()) of those next to psi = 0, with the
    /// reach of the options.
    /// @param[in] box       of whole leaves: no others are looked at
    /// @param[in] bumpsFor  none, or a function that receives psi on the leaves whose sign no
    ///                      bounds decide and returns bumps; psi has them from then on
    /// @return no leaves if psi is negative at all voxels
    SparseField band(int steps, const Progress& progress,
                     const openvdb::CoordBBox& box = openvdb::CoordBBox::inf(),
                     const BumpsFor& bumpsFor = {});

    /// psi is that of the balls and of these.
    void setBumps(const Bumps& bumps) { bumps_ = bumps; }
    const Bumps& bumps() const { return bumps_; }

    /// psi at all voxels of a leaf. In each octant of it the balls are left out whose terms are
    /// below e^-12 of the sum throughout, and those that are farther than R_i + reach + 2 eps from
    /// the leaf and below e^-12 where psi = 0.
    /// @param[in]  origin  first voxel of the leaf
    /// @param[in]  reach   how far outside the balls of radius R_i psi is wanted [Å]
    /// @param[out] psi     512 values; always finite
    void evaluate(const openvdb::Coord& origin, double reach, float* psi) const;

    /// A point between the voxels of a leaf.
    struct Point {
        float x, y, z; ///< [voxel], from the leaf's first voxel
    };

    /// psi and the square of its gradient [1/Å^2] at points of a leaf, not from voxels: exact to
    /// what evaluate() leaves out.
    /// @param[in] f  called with the number of each point, psi and the square
    template<typename F>
    void sample(const openvdb::Coord& origin, const std::vector<Point>& points, const F& f) const
    {
        const double h = options_.voxelSize;
        const GaussianTerms& terms = termsAt(origin, h);
        std::vector<float> scratch;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point& p = points[i];
            const PsiSample s = sampleTerms(terms, p.x, p.y, p.z, scratch);
            const openvdb::Vec3d gradient = openvdb::Vec3d(s.x, s.y, s.z) / h;
            const openvdb::Vec3d x = (origin.asVec3d() + openvdb::Vec3d(p.x, p.y, p.z)) * h;
            const PsiJet added = bumps_.jet(x);
            f(i, s.psi + float(added.psi), float((gradient + added.gradient).lengthSqr()));
        }
    }

    /// Counts the terms that evaluate() adds up at all voxels of a leaf.
    std::size_t productCount(const openvdb::Coord& origin, double reach) const;

    /// Evaluates psi at all voxels of all leaves, with the reach of the options.
    SparseField evaluate(LeafTable table, const Progress& progress) const;

    /// psi at a point with its derivatives, without bumps. Calls that follow from about there take
    /// less time: each thread keeps the balls that count in a cell of 1 Å.
    PsiJet jet(const openvdb::Vec3d& x) const;

    /// Calls f(ball, exponent, rate [1/Å^2], x - x_i [Å]) with the terms that may count at a point.
    template<typename F>
    void forEachTerm(const openvdb::Vec3d& x, const F& f) const
    {
        const double perVoxel = 1.0 / (options_.voxelSize * options_.voxelSize);
        index_.forEachRun(x, x, extent_.cutoff(0.0) - extent_.maxRadius,
                          [&](std::int32_t begin, std::int32_t end) {
                              for (std::int32_t k = begin; k < end; ++k) {
                                  const std::size_t i = std::size_t(k);
                                  const openvdb::Vec3d way =
                                      x - openvdb::Vec3d(lists_.x[i], lists_.y[i], lists_.z[i]);
                                  const double rate = perVoxel * double(lists_.decay[i]);
                                  f(index_.indexOf(i), lists_.level[i] - rate * way.lengthSqr(),
                                    rate, way);
                              }
                          });
    }

    /// The same for a tolerance so many times smaller.
    PsiJet sharpenedJet(const openvdb::Vec3d& x, double times) const;

    /// With bumps.
    PsiJet jetWithBumps(const openvdb::Vec3d& x) const
    {
        const PsiJet jet = this->jet(x), added = bumps_.jet(x);
        return {jet.psi + added.psi, jet.gradient + added.gradient, jet.hessian + added.hessian};
    }

private:
    /// The leaves that may hold a voxel with psi >= 0, and psi on those that bounds do not decide.
    struct Candidates {
        LeafTable table;
        std::vector<LeafMask> inside;     ///< where psi >= 0
        std::vector<std::int32_t> places; ///< index of each leaf in the sums; -1: bounds decide it
        LeafField sums;                   ///< psi, in the order in which threads came to leaves
    };
    Candidates candidates(const Progress& progress, const openvdb::CoordBBox& box) const;

    /// Adds the bumps to the sums; leaves that bounds had decided get a sum if a bump reaches them.
    void addBumps(Candidates& leaves, const Progress& progress) const;

    /// psi on the leaves that bounds do not decide. Leaves decided as inside are covered by balls:
    /// in each octant one term without the others has psi > 0.
    SparseField searched(const Candidates& leaves, const Progress& progress) const;

    const JetTerms& jetTermsAt(const openvdb::Vec3d& x) const;

    struct Leaf;
    Leaf& leafAt(const openvdb::Coord& origin, double reach) const;
    const GaussianTerms& termsAt(const openvdb::Coord& origin, double reach) const;

    std::uint64_t number_; // no two sums have the same
    GaussianOptions options_;
    GaussianExtent extent_; // of all balls
    BallIndex index_;
    GaussianLists lists_; // of the balls in the order of the index
    Bumps bumps_;
};

} // namespace molsurf
