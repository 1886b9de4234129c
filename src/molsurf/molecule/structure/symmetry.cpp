// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/symmetry.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <openvdb/math/Mat3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <utility>

namespace molsurf
{
namespace
{

using openvdb::Mat3d;
using openvdb::Vec3d;

constexpr double angleTolerance = M_PI / 180.0; // [rad]

/// x -> rotation (x - centre) + shift + centre, with rotation a rotation but for rounding.
struct CopyMotion {
    Mat3d rotation;
    Vec3d shift;
};

/// Rotation vector: unit axis times angle in [0, pi].
Vec3d rotationVector(const Mat3d& r)
{
    const Vec3d odd(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)); // 2 sin(angle) axis
    const double angle = std::atan2(odd.length(), r.trace() - 1.0);
    if (angle < 0.5 * M_PI) return odd.length() > 0.0 ? odd.unit() * angle : Vec3d(0.0);
    // Near pi the odd part vanishes: the axis is the largest column of (r + r^T)/2 - cos(angle).
    Mat3d even = 0.5 * (r + r.transpose());
    for (int i = 0; i < 3; ++i) even(i, i) -= std::cos(angle);
    Vec3d axis(0.0);
    for (int i = 0; i < 3; ++i) {
        if (even.col(i).lengthSqr() > axis.lengthSqr()) axis = even.col(i);
    }
    axis.normalize();
    return (axis.dot(odd) < 0.0 ? -axis : axis) * angle;
}

double angleBetween(const Mat3d& a, const Mat3d& b)
{
    return rotationVector(a.transpose() * b).length();
}

/// Finds copies by where they are and how they are turned.
class Copies
{
public:
    /// Rotations of the copies, and where they place a point, relative to the middle of all.
    /// @throws Error(ErrorKind::Input) if an operator is no rotation
    Copies(const Assembly& assembly, const Vec3d& reference)
        : operators_(operatorsOf(assembly)), parts_(partsOfCopies(assembly))
    {
        for (const Operator& op : operators_) {
            const std::string problem = rotationProblem(op);
            if (!problem.empty()) throw Error(ErrorKind::Input, problem);
            rotations_.push_back(nearestRotation(op.matrix()));
            positions_.push_back(op.placed(reference));
        }
        for (const Vec3d& x : positions_) centre_ += x / double(positions_.size());
        for (Vec3d& x : positions_) {
            x -= centre_;
            extent_ = std::max(extent_, x.length());
        }
        cell_ = 2.0 * tolerance();
        for (std::size_t i = 0; i < size(); ++i) cells_[cellOf(positions_[i])].push_back(i);
        first_.resize(size());
        for (std::size_t i = 0; i < size(); ++i) first_[i] = find(rotations_[i], positions_[i], i);
        leaveOutDuplicates();
    }

    std::size_t size() const { return operators_.size(); }
    std::size_t part(std::size_t i) const { return parts_[i]; }
    const Vec3d& centre() const { return centre_; }
    double tolerance() const { return 0.3 + 4e-3 * extent_; }
    bool isDuplicate(std::size_t i) const { return first_[i] != i; }

    double distance(std::size_t i, std::size_t j) const
    {
        return (positions_[i] - positions_[j]).length();
    }

    /// The motion that takes copy i onto copy j.
    CopyMotion between(std::size_t i, std::size_t j) const
    {
        const Mat3d r = rotations_[j] * rotations_[i].transpose();
        return {r, positions_[j] - r * positions_[i]};
    }

    /// The first copy of the same part that copy i is moved onto; size() if there is none.
    std::size_t image(const CopyMotion& motion, std::size_t i) const
    {
        return find(motion.rotation * rotations_[i], motion.rotation * positions_[i] + motion.shift,
                    i);
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cellOf(const Vec3d& x) const
    {
        Cell cell{};
        for (int i = 0; i < 3; ++i) {
            cell[std::size_t(i)] = static_cast<std::int64_t>(std::floor(x[i] / cell_));
        }
        return cell;
    }

    /// The first copy of the part of copy `like` with this rotation and position. Cells are two
    /// tolerances wide, so that those within one of the position lie in eight cells.
    std::size_t find(const Mat3d& rotation, const Vec3d& position, std::size_t like) const
    {
        std::size_t found = size();
        const Cell low = cellOf(position - Vec3d(tolerance()));
        for (int n = 0; n < 8; ++n) {
            const auto cell =
                cells_.find({low[0] + (n >> 2), low[1] + (n >> 1 & 1), low[2] + (n & 1)});
            if (cell == cells_.end()) continue;
            for (const std::size_t i : cell->second) {
                if (i < found && parts_[i] == parts_[like] &&
                    (positions_[i] - position).length() < tolerance() &&
                    angleBetween(rotations_[i], rotation) < angleTolerance) {
                    found = i;
                }
            }
        }
        return found;
    }

    /// Copies that stand more than once must not shift the centre.
    void leaveOutDuplicates()
    {
        Vec3d sum(0.0);
        double count = 0.0;
        for (std::size_t i = 0; i < size(); ++i) {
            if (isDuplicate(i)) continue;
            sum += positions_[i];
            ++count;
        }
        sum /= count;
        centre_ += sum;
        for (Vec3d& x : positions_) x -= sum;
        cells_.clear();
        for (std::size_t i = 0; i < size(); ++i) cells_[cellOf(positions_[i])].push_back(i);
    }

    std::vector<Operator> operators_;
    std::vector<std::size_t> parts_;
    std::vector<Mat3d> rotations_;
    std::vector<Vec3d> positions_; // of the reference point, from the centre [Å]
    std::vector<std::size_t> first_;
    Vec3d centre_{0.0};
    double extent_ = 0.0, cell_ = 1.0;
    std::map<Cell, std::vector<std::size_t>> cells_;
};

/// The copies to whose places a motion moves every copy; empty if it moves one to where none is.
std::vector<std::size_t> imagesOf(const Copies& copies, const CopyMotion& motion)
{
    std::vector<std::size_t> images(copies.size());
    std::vector<char> hit(copies.size());
    for (std::size_t i = 0; i < copies.size(); ++i) {
        images[i] = copies.image(motion, i);
        if (images[i] == copies.size()) return {};
        if (!copies.isDuplicate(i) && std::exchange(hit[images[i]], char{1})) return {};
    }
    return images;
}

/// The direction of a line: of u and -u the one whose last component that is not zero is positive.
Vec3d lineDirection(const Vec3d& u)
{
    constexpr double zero = 1e-3;
    for (int i = 2; i >= 0; --i) {
        if (std::abs(u[i]) > zero) return u[i] < 0.0 ? -u : u;
    }
    return u;
}

bool areParallel(const Vec3d& u, const Vec3d& v)
{
    return u.cross(v).length() < std::sin(1.5 * angleTolerance);
}

/// The Schoenflies symbol by the number and folds of the axes, as C5, D2, T, O or I.
std::string pointGroupOf(const Symmetry& symmetry)
{
    const std::size_t order = symmetry.order;
    auto count = [&](int fold) {
        return std::count_if(symmetry.axes.begin(), symmetry.axes.end(),
                             [fold](const RotationAxis& a) { return a.fold == fold; });
    };
    if (order == 1) return "C1";
    const auto axes = symmetry.axes.size();
    const int highest = symmetry.axes.front().fold;
    const auto fold = std::size_t(highest);
    if (axes == 1 && order == fold) return "C" + std::to_string(order);
    if (order == 4 && count(2) == 3) return "D2";
    if (order == 2 * fold && axes == fold + 1 && count(highest) == 1) {
        return "D" + std::to_string(fold);
    }
    if (order == 12 && count(3) == 4 && count(2) == 3) return "T";
    if (order == 24 && count(4) == 3 && count(3) == 4 && count(2) == 6) return "O";
    if (order == 60 && count(5) == 6 && count(3) == 10 && count(2) == 15) return "I";
    return "";
}

/// A rotation about a line and a translation along it.
struct Screw {
    Vec3d direction;
    double angle, rise;
    Vec3d point;      ///< of the line, nearest to the centre; any for a plain translation
    double tolerance; ///< of the rise [Å]
};

/// The screw motion of a rigid motion (Chasles): of the shift t, the part across the axis u gives
/// the point (t + u x t / tan(angle/2))/2 of the line.
/// @param[in] distance  that the motion moves the molecule by [Å]
Screw screwOf(const CopyMotion& motion, double distance)
{
    const double tolerance = 0.2 + 1e-3 * distance;
    const Vec3d turn = rotationVector(motion.rotation);
    const double angle = turn.length(), shift = motion.shift.length();
    if (angle < angleTolerance) {
        return {shift > 0.0 ? motion.shift / shift : Vec3d(0, 0, 1), 0.0, shift, Vec3d(0.0),
                tolerance};
    }
    const Vec3d u = turn / angle;
    const double rise = u.dot(motion.shift);
    const Vec3d across = motion.shift - rise * u;
    return {u, angle, rise, 0.5 * (across + u.cross(across) / std::tan(0.5 * angle)), tolerance};
}

/// The helix that all copies lie on, but for two-fold axes across it.
std::optional<Helix> findHelix(const Copies& copies)
{
    std::vector<Screw> screws;
    for (std::size_t j = 1; j < copies.size(); ++j) {
        if (copies.part(j) == copies.part(0) && !copies.isDuplicate(j)) {
            screws.push_back(screwOf(copies.between(0, j), copies.distance(0, j)));
        }
    }
    auto rises = [](const Screw& s) { return std::abs(s.rise) > s.tolerance; };
    const auto first = std::find_if(screws.begin(), screws.end(), rises);
    if (first == screws.end() || screws.size() < 2) return std::nullopt;
    const Screw axis = *first;
    for (const Screw& s : screws) {
        const bool turned = s.angle > 0.0 && axis.angle > 0.0;
        const Vec3d gap = s.point - axis.point;
        const double apart = (gap - axis.direction.dot(gap) * axis.direction).length();
        const double least = turned ? std::min({s.angle, axis.angle, 1.0}) : 1.0;
        const bool along = areParallel(s.direction, axis.direction) &&
                           (!turned || apart < copies.tolerance() / least);
        const bool across = std::abs(s.angle - M_PI) < angleTolerance && !rises(s) &&
                            std::abs(s.direction.dot(axis.direction)) < angleTolerance;
        if (!along && !across) return std::nullopt;
    }
    Helix helix{lineDirection(axis.direction), 0.0, 0.0};
    for (const Screw& s : screws) {
        if (!rises(s) || !areParallel(s.direction, axis.direction)) continue;
        // A screw that goes down about u by an angle is one that goes up about -u by its negative.
        const double rise = std::abs(s.rise), twist = s.rise > 0.0 ? s.angle : -s.angle;
        const bool better =
            helix.rise == 0.0 || rise < helix.rise - s.tolerance ||
            (rise < helix.rise + s.tolerance && std::abs(twist) < std::abs(helix.twist));
        if (better) helix = {helix.direction, rise, twist};
    }
    return helix;
}

/// The axes of a group of rotations that are given with their images.
std::vector<RotationAxis> axesOf(const std::vector<Mat3d>& rotations,
                                 std::vector<std::vector<std::size_t>> images)
{
    std::vector<RotationAxis> axes;
    for (std::size_t k = 0; k < rotations.size(); ++k) {
        const Vec3d direction = lineDirection(rotationVector(rotations[k]).unit());
        auto axis = std::find_if(axes.begin(), axes.end(), [&](const RotationAxis& a) {
            return areParallel(a.direction, direction);
        });
        if (axis == axes.end()) axis = axes.insert(axis, {1, direction, {}});
        ++axis->fold;
        axis->images.push_back(std::move(images[k]));
    }
    std::stable_sort(axes.begin(), axes.end(),
                     [](const RotationAxis& a, const RotationAxis& b) { return a.fold > b.fold; });
    return axes;
}

} // namespace

std::vector<Operator> operatorsOf(const Assembly& assembly)
{
    std::vector<Operator> all;
    for (const AssemblyPart& part : assembly.parts) {
        all.insert(all.end(), part.operators.begin(), part.operators.end());
    }
    return all;
}

std::vector<std::size_t> partsOfCopies(const Assembly& assembly)
{
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < assembly.parts.size(); ++i) {
        all.insert(all.end(), assembly.parts[i].operators.size(), i);
    }
    return all;
}

std::string rotationProblem(const Operator& op)
{
    constexpr double tolerance = 0.02;
    const Mat3d m = op.matrix();
    const std::string expected = "operator " + inQuotes(op.name) + ": expected a rotation, got ";
    std::ostringstream determinant;
    determinant << " (determinant " << m.det() << ")";
    if (m.det() < -tolerance) return expected + "a reflection" + determinant.str();
    const Mat3d rest = m * m.transpose() - Mat3d::identity();
    for (int i = 0; i < 9; ++i) {
        if (!(std::abs(rest(i / 3, i % 3)) <= tolerance)) {
            return expected + "a matrix that distorts" + determinant.str();
        }
    }
    return "";
}

Mat3d nearestRotation(Mat3d m)
{
    // Newton's iteration for the orthogonal factor of the polar decomposition (N. Higham, SIAM J.
    // Sci. Stat. Comput. 7:1160-1174, 1986).
    for (int i = 0; i < 4; ++i) m = 0.5 * (m + m.inverse().transpose());
    return m;
}

Symmetry findSymmetry(const Assembly& assembly, const openvdb::Vec3d& reference)
{
    Symmetry symmetry;
    if (operatorsOf(assembly).empty()) return {"C1", 1, reference, {}, {}};
    const Copies copies(assembly, reference);
    symmetry.centre = copies.centre();
    std::vector<Mat3d> rotations;
    std::vector<std::vector<std::size_t>> images;
    std::size_t inPart = 0; // distinct copies of the part of the first copy
    for (std::size_t j = 0; j < copies.size(); ++j) {
        if (copies.part(j) != copies.part(0) || copies.isDuplicate(j)) continue;
        ++inPart;
        const CopyMotion motion = copies.between(0, j);
        if (j == 0 || rotationVector(motion.rotation).length() < angleTolerance) continue;
        std::vector<std::size_t> to = imagesOf(copies, motion);
        if (to.empty()) continue;
        rotations.push_back(motion.rotation);
        images.push_back(std::move(to));
    }
    symmetry.order = rotations.size() + 1;
    symmetry.axes = axesOf(rotations, std::move(images));
    symmetry.pointGroup = pointGroupOf(symmetry);
    if (symmetry.order < inPart) symmetry.helix = findHelix(copies);
    return symmetry;
}

} // namespace molsurf
