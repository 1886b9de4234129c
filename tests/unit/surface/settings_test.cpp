// SPDX-License-Identifier: MPL-2.0
// The table of settings: every row sets and gives back what it says.

#include "molsurf/error.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/request/resolve.h"
#include "molsurf/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace molsurf
{
namespace
{

const Setting& row(const std::string& name)
{
    for (const Setting& one : settingTable())
        if (one.name == name) return one;
    throw std::out_of_range(name);
}

std::string messageOf(const std::string& name, const std::vector<std::string>& values)
{
    Settings settings;
    try {
        row(name).set(settings, values);
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Usage);
        return e.what();
    }
    return "taken";
}

/// A value that each type of row takes, other than the default.
std::string exampleOf(const Setting& setting)
{
    if (setting.type == SettingType::Word) return setting.words.back();
    if (setting.type == SettingType::Number) return "0.75";
    if (setting.type == SettingType::Whole) return "2";
    const std::string name = setting.name;
    return name == "max-input"    ? "5G"
           : name == "copies"     ? "1,3"
           : name == "fields"     ? "spline"
           : name == "resolution" ? "*=8"
           : name == "coarse"     ? "residue"
           : name == "surface-of" ? "core=ses"
           : name == "color"      ? "element"
           : name == "range"      ? "1,2"
           : name == "patches"    ? "mean-curvature<-0.1"
                                  : "chain";
}

TEST(Settings, HaveNamesOfTheirOwnAndTextsWithoutOptions)
{
    std::set<std::string> names;
    for (const Setting& setting : settingTable()) {
        EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
        EXPECT_EQ(setting.text.find("--"), std::string::npos) << setting.name;
        EXPECT_EQ(setting.value == nullptr, setting.type == SettingType::Switch) << setting.name;
        ASSERT_TRUE(setting.set) << setting.name;
    }
    EXPECT_EQ(names.count("voxel"), 1u);
    EXPECT_GT(names.size(), 35u);
}

TEST(Settings, EachChangesWhatItGives)
{
    for (const Setting& setting : settingTable()) {
        Settings settings;
        if (!setting.get) continue;
        const SettingValue before = setting.get(settings);
        setting.set(settings, setting.value ? std::vector<std::string>{exampleOf(setting)}
                                            : std::vector<std::string>{});
        EXPECT_NE(setting.get(settings), before) << setting.name;
        // Whatever it gives is taken again.
        const SettingValue after = setting.get(settings);
        if (const auto* text = std::get_if<std::string>(&after)) {
            Settings again;
            setting.set(again, {*text});
            EXPECT_EQ(setting.get(again), after) << setting.name;
        }
    }
}

TEST(Settings, RangesAreThoseThatAreChecked)
{
    const auto allows = [](const Setting& setting, double value) {
        Settings settings;
        if (setting.name == std::string("adapt")) settings.options.meshEdge = 1.0;
        try {
            setting.set(settings,
                        {setting.type == SettingType::Whole ? std::to_string(std::lround(value))
                                                            : std::to_string(value)});
            checkOptions(settings.options);
        } catch (const Error&) {
            return false;
        }
        return true;
    };
    int ranges = 0;
    for (const Setting& setting : settingTable()) {
        if (!std::isfinite(setting.low)) continue;
        ++ranges;
        const double beyond = setting.type == SettingType::Whole ? 1.0 : 1e-3;
        EXPECT_TRUE(allows(setting, setting.low)) << setting.name;
        EXPECT_TRUE(allows(setting, setting.high)) << setting.name;
        EXPECT_FALSE(allows(setting, setting.low - beyond)) << setting.name;
        EXPECT_FALSE(allows(setting, setting.high + beyond)) << setting.name;
    }
    EXPECT_EQ(ranges, 16);
}

TEST(Settings, TakeResolutionsFrom1To50)
{
    for (const char* taken : {"1", "50", "A=1"})
        EXPECT_EQ(messageOf("resolution", {taken}), "taken");
    for (const char* refused : {"0.99", "50.1", "A=0.5"})
        EXPECT_NE(messageOf("resolution", {refused}).find("1 to 50"), std::string::npos) << refused;
}

TEST(Settings, NameTheMemberOfAWrongValue)
{
    EXPECT_EQ(messageOf("voxel", {"fine"}), "`voxel`: expected a number, got 'fine'");
    EXPECT_EQ(messageOf("max-input", {"much"}),
              "`maxInput`: expected a size such as 500M or 4G, got 'much'");
    EXPECT_EQ(messageOf("surface", {"see"}),
              "`surface`: expected variational or ses or sas or vdw or gaussian or smooth-sas, got "
              "'see' [hint: did you mean ses?]");
    EXPECT_EQ(messageOf("surface-of", {"core"}),
              "`surfaceOf`: expected GROUP=KIND with a kind of `surface`, got 'core'");
    EXPECT_EQ(messageOf("max-steps", {"1.5"}),
              "`maxSteps`: expected a whole number from 0 to 1000000, got '1.5'");
    EXPECT_EQ(messageOf("fields", {"curvature,mean_curvture"}).find("`fields`: unknown field"), 0u);
    EXPECT_EQ(messageOf("range", {"2,1"}), "`range`: expected two numbers LOW,HIGH, the first one "
                                           "less, got '2,1' [hint: did you mean 1,2?]");
}

TEST(Settings, AColorSaysWhatElseItNeeds)
{
    Settings settings;
    row("color").set(settings, {"bfactor"});
    EXPECT_EQ(settings.options.color, ColorBy::Value);
    EXPECT_EQ(settings.labels.valueBy->kind, ValueBy::Kind::BFactor);
    row("color").set(settings, {"entity"});
    EXPECT_EQ(textOf(*settings.colorGroups), "entity");
    EXPECT_FALSE(settings.labels.valueBy);
    row("color").set(settings, {"plain=#102030"});
    EXPECT_EQ(settings.options.color, ColorBy::Plain);
    EXPECT_EQ((*settings.labels.plainColor)[1], 0x20);
    row("color").set(settings, {"Table=Values.csv"});
    EXPECT_EQ(settings.labels.valueBy->file, "Values.csv");
    const std::string table = "table=Values.csv", patches = "Potential=a<b>.dx>1.5";
    EXPECT_EQ(row("color").file(table), "Values.csv");
    EXPECT_EQ(row("patches").file(patches), "a<b>.dx");
    EXPECT_EQ(row("patches").file("hydrophobicity>0"), "");
}

// Warnings name settings that change none of the surfaces, and lengths that voxels do not resolve.
TEST(Settings, ThatChangeNothingAreNamed)
{
    const auto warningsOf = [](const Settings& settings, const std::string& given,
                               const std::vector<SurfaceKind>& more = {}) {
        return settingWarnings(
            settings, [&](const char* name) { return given == name; }, more);
    };
    Settings settings;
    settings.options.voxel = 0.8;
    settings.options.epsilon = 0.39;
    EXPECT_EQ(
        warningsOf(settings, "epsilon"),
        std::vector<std::string>{"`epsilon` 0.39: a tolerance below half a voxel is not resolved"});
    EXPECT_TRUE(warningsOf(settings, "").empty());
    settings.options.epsilon = 0.4;
    EXPECT_TRUE(warningsOf(settings, "epsilon").empty());
    settings.options.kind = SurfaceKind::SolventExcluded;
    ASSERT_EQ(warningsOf(settings, "epsilon").size(), 1u);
    EXPECT_EQ(warningsOf(settings, "epsilon")[0].find("`epsilon` is for `surface` variational"),
              0u);
    EXPECT_TRUE(warningsOf(settings, "epsilon", {SurfaceKind::Variational}).empty());
    settings.options.surfaceOf = {{"core", SurfaceKind::Variational}};
    EXPECT_TRUE(warningsOf(settings, "epsilon").empty());
    settings.options.voxel = coarseVoxel;
    EXPECT_TRUE(warningsOf(settings, "").empty());
    settings.options.voxel = coarseVoxel + 0.25;
    ASSERT_EQ(warningsOf(settings, "").size(), 1u);
    EXPECT_NE(warningsOf(settings, "")[0].find("cannot show the atoms"), std::string::npos);
}

} // namespace
} // namespace molsurf
