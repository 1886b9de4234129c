// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/resolve.h"

#include "molsurf/error.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/set_value.h"

#include <algorithm>

namespace molsurf
{

namespace
{

/// The kinds of all surfaces that are built.
std::vector<SurfaceKind> kindsOf(const SurfaceOptions& options, std::vector<SurfaceKind> more)
{
    more.push_back(options.kind);
    if (hasField(options.fields, "sas")) more.push_back(SurfaceKind::SolventAccessible);
    for (const auto& [group, kind] : options.surfaceOf) more.push_back(kind);
    return more;
}

/// Puts the atoms of a group in the place of its name.
/// @param[in,out] select  of a resolution
void resolveName(const LabelOptions& labels, std::string& select)
{
    for (const auto* rules : {&labels.groups, &labels.colorGroups}) {
        for (const GroupRule& rule : *rules) {
            if (rule.name != select) continue;
            if (!rule.copies.all())
                throw Error(ErrorKind::Usage,
                            "`resolution`: expected a group of all copies, got '" + select +
                                "', which has some");
            select = rule.select;
            return;
        }
    }
}

} // namespace

void resolveGroups(Settings& settings, bool coloredGrid)
{
    LabelOptions& labels = settings.labels;
    SurfaceOptions& options = settings.options;
    if (!settings.colorGroupsFile.empty())
        labels.colorGroups = readGroups(settings.colorGroupsFile, settings.atoms.limits.maxInput);
    const bool parts = options.interfaces || options.ofParts();
    if (parts && labels.groups.empty() && !labels.groupBy) labels.groups = labels.colorGroups;
    for (ResolutionRule& rule : settings.atoms.resolutions) resolveName(labels, rule.select);
    if (options.interfaces && labels.groups.empty() && !labels.groupBy && !settings.colorGroups)
        labels.groupBy = GroupBy{GroupBy::Kind::Chain};
    const bool copies = settings.colorsCopies();
    if (settings.colorGroups && !copies) {
        labels.groupBy = settings.colorGroups;
        options.color = ColorBy::Group;
    }
    if (((coloredGrid && !copies) || hasField(options.fields, "Cd")) &&
        options.color == ColorBy::Nothing)
        options.color = ColorBy::Chain;
}

std::vector<std::string> settingWarnings(const Settings& settings,
                                         const std::function<bool(const char*)>& isGiven,
                                         const std::vector<SurfaceKind>& more)
{
    const SurfaceOptions& options = settings.options;
    const std::vector<SurfaceKind> built = kindsOf(options, more);
    std::vector<std::string> warnings;
    for (const Setting& row : settingTable()) {
        const auto isChanged = [&](SurfaceKind kind) {
            return std::count(row.kinds.begin(), row.kinds.end(), kind) > 0;
        };
        if (row.kinds.empty() || !isGiven(row.name) ||
            std::any_of(built.begin(), built.end(), isChanged))
            continue;
        std::vector<std::string> words;
        for (const SurfaceKind kind : row.kinds) words.push_back(nameOf(kind));
        warnings.push_back(memberName(row.name) + " is for `surface` " + joinWords(words, " or "));
    }
    if (options.voxel > coarseVoxel)
        warnings.push_back("`voxel` " + shortest(options.voxel) +
                           ": voxels this large cannot show the atoms");
    if (isGiven("epsilon") && std::any_of(built.begin(), built.end(), hasFlow) &&
        options.epsilon < 0.5 * options.voxel)
        warnings.push_back("`epsilon` " + shortest(options.epsilon) +
                           ": a tolerance below half a voxel is not resolved");
    return warnings;
}

} // namespace molsurf
