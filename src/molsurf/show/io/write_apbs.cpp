// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_apbs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/show/io/dx_array.h"

#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Where a surface lies along lines.
class Crossings
{
public:
    explicit Crossings(const MapSurface& surface)
        : values_(surface.levelSet.getConstAccessor()), spline_(surface.spline),
          voxel_(surface.levelSet.voxelSize()[0]), transform_(surface.levelSet.transform())
    {
    }

    /// The distance from the surface, which ends at the rim of the band [Å].
    double distance(const Vec3d& x)
    {
        const double linear =
            double(openvdb::tools::BoxSampler::sample(values_, transform_.worldToIndex(x)));
        return std::abs(linear) < voxel_ ? spline_.at(x).value : linear;
    }

    /// The share of an edge that lies inside: steps of half a voxel, and bisection in those whose
    /// ends have different signs.
    /// @param[in] from, to  distances at its ends
    double inside(const Vec3d& begin, const Vec3d& end, double from, double to)
    {
        const double length = (end - begin).length();
        if (from * to > 0.0 && std::abs(from) + std::abs(to) > length)
            return from < 0.0 ? 1.0 : 0.0;
        const int steps = int(std::ceil(2.0 * length / voxel_));
        double share = 0.0, before = from, last = 0.0;
        for (int n = 1; n <= steps; ++n) {
            const double t = double(n) / steps;
            const double here = n == steps ? to : distance(begin + t * (end - begin));
            if ((before < 0.0) == (here < 0.0)) {
                share += before < 0.0 ? t - last : 0.0;
            } else {
                const double at = crossing(begin, end, {last, t}, before < 0.0);
                share += before < 0.0 ? at - last : t - at;
            }
            before = here;
            last = t;
        }
        return share;
    }

private:
    /// Where the spline is 0 between two places of a line, one on each side.
    double crossing(const Vec3d& begin, const Vec3d& end, std::pair<double, double> between,
                    bool leaves)
    {
        auto [low, high] = between;
        constexpr int halvings = 20;
        for (int n = 0; n < halvings; ++n) {
            const double middle = 0.5 * (low + high);
            const double value = spline_.at(begin + middle * (end - begin)).value;
            ((value < 0.0) == leaves ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    openvdb::FloatGrid::ConstAccessor values_;
    SplineSampler spline_;
    double voxel_;
    const openvdb::math::Transform& transform_;
};

/// Numbers behind a word of APBS's input, as they are asked for.
std::optional<std::array<double, 3>> threeNumbers(std::istringstream& words)
{
    std::array<double, 3> out{};
    for (double& number : out)
        if (!(words >> number) || !std::isfinite(number)) return std::nullopt;
    return out;
}

[[noreturn]] void refuseGrid(const std::string& path, int line, const std::string& what)
{
    throw Error(ErrorKind::Input,
                path + (line > 0 ? ", line " + std::to_string(line) : "") + ": " + what);
}

/// Whether APBS takes a number of points, c 2^(l + 1) + 1, as it is.
/// measured: apbs of an ion on 5 to 209 points: above 65 it changes all but 32 c + 1 to 65, and
/// some below that are not 8 c + 1 do not end
bool isHalved(double points)
{
    constexpr double few = 65.0, most = 1e6;
    return points >= 9.0 && points < most &&
           std::fmod(points - 1.0, points > few ? 32.0 : 8.0) == 0.0;
}

} // namespace

ApbsGrid gridAround(const PointCharges& charges)
{
    const openvdb::BBoxd box = charges.box(true);
    ApbsGrid grid;
    grid.center = box.getCenter();
    constexpr double beyond = 20.0, widest = 1.7, apart = 0.5; // psize: fadd, cfac, space
    for (int axis = 0; axis < 3; ++axis) {
        const double size = std::max(0.1, box.extents()[axis]);
        grid.lengths[axis] = std::min(size + beyond, widest * size);
        const int points = int(grid.lengths[axis] / apart + 0.5);
        grid.points[std::size_t(axis)] = std::max(33, 32 * int((points - 1) / 32.0 + 0.5) + 1);
    }
    constexpr double bytes = 200.0, ceiling = 400.0 * 1024 * 1024; // psize: gmemfac, gmemceil
    auto& n = grid.points;
    while (bytes * n[0] * n[1] * n[2] >= ceiling) {
        const Vec3d h = grid.spacing();
        const auto finest = std::size_t(openvdb::math::MinIndex(h)); // axes stay alike
        n[finest] -= 32;
    }
    return grid;
}

ApbsGrid readApbsGrid(const std::string& path, const PointCharges& charges)
{
    constexpr std::size_t enough = 1 << 20; // bytes
    const std::string text = loadSmallText(path, enough);
    std::map<std::string, std::array<double, 3>> found;
    int calculations = 0;
    for (LineReader lines(text); lines.next();) {
        const int line = int(lines.number());
        std::istringstream words{std::string(lines.line().substr(0, lines.line().find('#')))};
        std::string word, second;
        words >> word;
        word = lowered(word);
        if (word == "elec" && ++calculations == 2) break;
        const bool fine = word == "fglen" || word == "fgcent";
        if (fine) word.erase(0, 1);
        if (word != "dime" && word != "glen" && word != "gcent") continue;
        const auto start = words.tellg();
        if (word == "gcent" && words >> second && lowered(second) == "mol") {
            const Vec3d middle = charges.box(false).getCenter();
            found[word] = {middle[0], middle[1], middle[2]};
            continue;
        }
        words.clear();
        words.seekg(start);
        const auto numbers = threeNumbers(words);
        if (!numbers) refuseGrid(path, line, "expected three numbers behind " + word);
        for (const double n : *numbers) {
            if (word == "dime" && !isHalved(n))
                refuseGrid(path, line,
                           formatted("expected dime 8c+1 up to 65 and 32c+1 above, got %g", n));
            if (word == "glen" && n <= 0.0)
                refuseGrid(path, line, formatted("expected lengths above 0, got %g", n));
        }
        found[word] = *numbers;
    }
    ApbsGrid grid;
    for (const char* word : {"dime", "glen", "gcent"})
        if (!found.count(word))
            refuseGrid(path, 0, std::string("expected dime, glen and gcent, got no ") + word);
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t a = std::size_t(axis);
        grid.points[a] = int(found["dime"][a]);
        grid.lengths[axis] = found["glen"][a];
        grid.center[axis] = found["gcent"][a];
    }
    return grid;
}

void checkCovers(const ApbsGrid& grid, const std::vector<Ball>& balls)
{
    const openvdb::BBoxd box = boxOf(balls);
    Vec3d needed(0.0);
    for (int axis = 0; axis < 3; ++axis)
        needed[axis] = 2.0 * std::max(box.max()[axis] - grid.center[axis],
                                      grid.center[axis] - box.min()[axis]);
    for (int axis = 0; axis < 3; ++axis)
        if (grid.lengths[axis] < needed[axis])
            throw Error(ErrorKind::Input,
                        formatted("the grid is too small for the molecule: expected glen of at "
                                  "least %.4g %.4g %.4g, got %.4g %.4g %.4g",
                                  needed[0], needed[1], needed[2], grid.lengths[0], grid.lengths[1],
                                  grid.lengths[2]));
}

void writeDielectricMap(const MapSurface& surface, const ApbsGrid& grid, int axis,
                        const Dielectric& constants, OutputFile& file)
{
    const auto [nx, ny, nz] = grid.points;
    Crossings along(surface);
    // Distances at the nodes of a slab, and at those where its last edges along y and z end.
    const auto slab = [&, ny = ny, nz = nz](int i) {
        std::vector<float> distances(std::size_t(ny + 1) * std::size_t(nz + 1));
        for (int j = 0, at = 0; j <= ny; ++j)
            for (int k = 0; k <= nz; ++k)
                distances[std::size_t(at++)] = float(along.distance(grid.node(i, j, k)));
        return distances;
    };
    Vec3d step(0.0);
    step[axis] = grid.spacing()[axis];
    const std::array<std::size_t, 3> ahead = {0, std::size_t(nz + 1), 1}; // in a slab, by axis
    TextOutput out(file);
    DxArray array(formatted("dielectric at the middles of edges along %c", "xyz"[axis]),
                  grid.points, grid.node(0, 0, 0) + 0.5 * step, grid.spacing(), out);
    std::vector<float> here = slab(0);
    for (int i = 0; i < nx; ++i) {
        std::vector<float> next = axis == 0 || i + 1 < nx ? slab(i + 1) : std::vector<float>();
        for (int j = 0; j < ny; ++j)
            for (int k = 0; k < nz; ++k) {
                const std::size_t at = std::size_t(j) * std::size_t(nz + 1) + std::size_t(k);
                const Vec3d x = grid.node(i, j, k);
                const double f =
                    along.inside(x, x + step, double(here[at]),
                                 double(axis == 0 ? next[at] : here[at + ahead[axis]]));
                array.add(1.0 / (f / constants.inside + (1.0 - f) / constants.outside));
            }
        here = std::move(next);
    }
    array.finish();
}

void writeIonMap(const std::vector<Ball>& balls, const ApbsGrid& grid, double ionRadius,
                 OutputFile& file)
{
    const auto [nx, ny, nz] = grid.points;
    const Vec3d h = grid.spacing(), corner = grid.node(0, 0, 0);
    TextOutput out(file);
    DxArray array("1 where ions may be, 0 within the radius of an ion of an atom", grid.points,
                  corner, h, out);
    std::vector<char> closed; // nodes of a slab: the chords of each ball are drawn into it
    for (int i = 0; i < nx; ++i) {
        closed.assign(std::size_t(ny) * std::size_t(nz), 0);
        for (const Ball& ball : balls) {
            const double R = ball.radius + ionRadius;
            const Vec3d from = ball.center - corner;
            const double dx = i * h[0] - from[0], inSlab = R * R - dx * dx;
            if (inSlab <= 0.0) continue;
            const auto first = [&](int axis, double reach) {
                return std::max(0, int(std::ceil((from[axis] - reach) / h[axis])));
            };
            const auto last = [&](int axis, double reach, int n) {
                return std::min(n - 1, int(std::floor((from[axis] + reach) / h[axis])));
            };
            const double reach = std::sqrt(inSlab);
            for (int j = first(1, reach); j <= last(1, reach, ny); ++j) {
                const double dy = j * h[1] - from[1], inRow = inSlab - dy * dy;
                if (inRow <= 0.0) continue;
                const double row = std::sqrt(inRow);
                for (int k = first(2, row); k <= last(2, row, nz); ++k)
                    closed[std::size_t(j) * std::size_t(nz) + std::size_t(k)] = 1;
            }
        }
        for (const char one : closed) array.add(one ? 0.0 : 1.0);
    }
    array.finish();
}

void writePqr(const PointCharges& charges, OutputFile& file)
{
    TextOutput out(file);
    out << "REMARK  vdb_molsurf: the charges that the surface is of\n";
    int serial = 0;
    for (const PointCharge& atom : charges.atoms) {
        const auto named = [](const std::string& name, const char* none) {
            return name.empty() ? std::string(none) : name;
        };
        out << formatted("ATOM  %5d %-4s %-4s %5d ", ++serial, named(atom.atom, "X").c_str(),
                         named(atom.residue, "UNK").c_str(), atom.number);
        for (int axis = 0; axis < 3; ++axis) out << " " << atom.position[axis];
        out << formatted(" %.6g %.6g\n", atom.charge, atom.radius);
    }
    out << "END\n";
    out.finish();
}

void writeApbsInput(const std::string& title, const ApbsFiles& files, const ApbsGrid& grid,
                    const Dielectric& constants, OutputFile& file)
{
    TextOutput out(file);
    const auto three = [&](const char* word, const auto& values) {
        out << "    " << word;
        for (int axis = 0; axis < 3; ++axis) out << " " << values[std::size_t(axis)];
        out << "\n";
    };
    out << "# " << title << "\nread\n    mol pqr " << files.charges << "\n    diel dx";
    for (const std::string& map : files.dielectric) out << " " << map;
    out << "\n    kappa dx " << files.kappa << "\nend\n";
    for (const bool solvated : {true, false}) {
        out << "elec name " << (solvated ? "solvated" : "reference") << "\n    mg-manual\n";
        three("dime", grid.points);
        const std::array<double, 3> lengths = {grid.lengths[0], grid.lengths[1], grid.lengths[2]},
                                    center = {grid.center[0], grid.center[1], grid.center[2]};
        three("glen", lengths);
        three("gcent", center);
        out << "    mol 1\n    lpbe\n    bcfl mdh\n";
        if (solvated && constants.salt > 0.0)
            for (const char* charge : {"1", "-1"})
                out << "    ion charge " << charge << " conc " << constants.salt << " radius "
                    << constants.ionRadius << "\n";
        out << "    pdie " << constants.inside << "\n    sdie "
            << (solvated ? constants.outside : constants.inside)
            << "\n    chgm spl2\n    srfm smol\n    srad 1.4\n    swin 0.3\n    sdens 10\n"
               "    temp 298.15\n";
        if (solvated) out << "    usemap diel 1\n";
        if (solvated && constants.salt > 0.0) out << "    usemap kappa 1\n";
        out << "    calcenergy total\n    calcforce no\nend\n";
    }
    out << "print elecEnergy solvated - reference end\nquit\n";
    out.finish();
}

} // namespace molsurf
