// SPDX-License-Identifier: MIT
// Every kind of mistake gives its message at its place.
#include "test_case_file_support.hpp"

#include "hyoryu/scene/parameter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hyoryu::test_case_file_errors {

namespace {

using testing::Test;

/// A mistake made by lines added to the short case: where it is found and what its text holds.
struct Mistake {
    std::string lines;
    int line; // after the short case; 0 if the mistake has no place
    int column;
    int length;
    std::string key;
    std::string what;
    std::string hint;
};

void expect_found(const Mistake& m, const std::vector<Diagnostic>& all)
{
    SCOPED_TRACE(m.lines);
    const Diagnostic d = mistake_at(all, m.key);
    EXPECT_EQ(d.file, "case.toml");
    EXPECT_EQ(d.line, m.line > 0 ? m.line + short_lines : 0) << to_string(d);
    EXPECT_EQ(d.column, m.column) << to_string(d);
    EXPECT_EQ(d.length, m.length) << to_string(d);
    EXPECT_NE(d.what.find(m.what), std::string::npos) << to_string(d);
    EXPECT_NE(d.hint.find(m.hint), std::string::npos) << to_string(d);
}

const std::string sphere = "[[body]]\nshape = \"sphere\"\nposition = [0, 0, 5]\n";

} // namespace

TEST(CaseFileErrors, EachKindIsToldAtItsPlace)
{
    const std::vector<Mistake> all = {
        {"[output]\nevry = 1\n", 2, 1, 4, "output.evry", "unknown key", "did you mean \"every\"?"},
        {"[outputs]\nevery = 1\n", 1, 2, 7, "outputs", "unknown key", "\"output\""},
        {"[output]\nevery = true\n", 2, 9, 4, "output.every", "expected a number in s, found true",
         ""},
        {"[output]\nevery = \"10 m\"\n", 2, 9, 6, "output.every",
         "the unit \"m\" has another dimension, expected s", "ms, min, h"},
        {"[output]\nevery = \"10 sec\"\n", 2, 9, 8, "output.every", "unknown unit \"sec\"", ""},
        {"[output]\nevery = \"10\"\n", 2, 9, 4, "output.every", "has no unit", "10 s"},
        {"[output]\nevery = \"soon\"\n", 2, 9, 6, "output.every", "found the text \"soon\"", ""},
        {"[output]\nevery = -0.5\n", 2, 9, 4, "output.every",
         "-0.5 s is out of range, expected > 0 s", ""},
        {"[output]\nevery = inf\n", 2, 9, 3, "output.every", "not a finite number", ""},
        {"[output]\nfields = [\"id\", \"speed\"]\n", 2, 17, 7, "output.fields[1]",
         "expected one of \"velocity\"", ""},
        {"[output]\nfields = \"id\"\n", 2, 10, 4, "output.fields", "expected a list", ""},
        {"[contact]\nrestitution = 1.5\n", 2, 15, 3, "contact.restitution", "expected 0 .. 1", ""},
        {"[contact]\nmethod = \"penalty\"\nlaw = \"paper\"\n", 3, 7, 7, "contact.law",
         "has no meaning with method = \"penalty\"", "omit `law`"},
        {"[contact]\nmethod = \"penalty\"\nlocating_share = 0.1\n", 3, 18, 3,
         "contact.locating_share", "has no meaning with method = \"penalty\"",
         "omit `locating_share`"},
        {"[contact]\nlocating_share = -0.1\n", 2, 18, 4, "contact.locating_share", "expected >= 0",
         ""},
        {"[contact.penalty]\nstiffness = 2e3\n", 1, 1, 17, "contact.penalty",
         "has no meaning with method = \"impulse\"", "write method = \"penalty\""},
        {"[contact]\nlaw = \"paperr\"\n", 2, 7, 8, "contact.law",
         "expected one of \"coupled\", \"paper\"", "did you mean \"paper\"?"},
        {"[contact]\nmethod = \"penalty\"\n[contact.penalty]\nstep = 0\n", 4, 8, 1,
         "contact.penalty.step", "expected > 0 s", ""},
        {"[domain]\nmin = [0, 0]\nmax = [1, 1, 1]\n", 2, 7, 6, "domain.min",
         "expected 3 numbers, found 2", ""},
        {"[domain]\nmin = [0, 0, 0]\nmax = [1, -1, 1]\n", 3, 7, 10, "domain.max",
         "y = -1 m is not above 0 m", "smallest x, y and z"},
        {"[domain]\nmin = [0, 0, 0]\nmax = [1, 1, \"1 s\"]\n", 3, 14, 5, "domain.max[2]",
         "has another dimension", ""},
        {"[domain]\nmin = [0,0,0]\nmax = [1,1,1]\nperiodic = [\"w\"]\n", 4, 12, 5,
         "domain.periodic", "is not a direction", "\"x\""},
        {"[domain]\nmin = [0,0,0]\nmax = [1,1,1]\nperiodic = [\"z\"]\n", 4, 12, 5,
         "domain.periodic", "`gravity` points along z", ""},
        {"[domain]\nmin = [0,0,0]\nmax = [1.05,1,1]\nperiodic = [\"x\"]\n", 4, 12, 5,
         "domain.periodic", "10.5 spacings long, expected a whole number", "for instance"},
        {"[domain]\nmin = [0,0,0]\nmax = [0.9,1,1]\nperiodic = [\"x\"]\n", 4, 12, 5,
         "domain.periodic", "9 spacings long, expected a whole number of at least 10",
         "for instance 1 m, 10 spacings"},
        {"[fluid.shifting]\nmodel = \"sun\"\ncoefficient = -1\n", 3, 15, 2,
         "fluid.shifting.coefficient", "expected >= 0", ""},
        {"[domain]\nmin = [0,0,0]\n", 1, 1, 8, "domain.max", "is missing", "Upper corner"},
        {"[wall]\nshape = \"plane\"\n", 1, 1, 6, "wall", "expected a list of tables", "[[wall]]"},
        {"[[output]]\nevery = 1\n", 1, 1, 10, "output", "expected a table", "[output]"},
        {"[[wall]]\nshape = \"plane\"\nnormal = [0, 0, 0]\n", 3, 10, 9, "wall[0].normal",
         "no direction", ""},
        {"[[wall]]\nshape = \"terrain\"\n", 1, 1, 8, "wall[0].file", "is missing",
         "ESRI ASCII grid"},
        {"[[wall]]\nshape = \"plane\"\n[wall.motion]\ntable = \"x.csv\"\n", 4, 9, 7,
         "wall[0].motion.table", "x.csv does not exist", "relative to the case file"},
        {"[[wall]]\nshape = \"plane\"\n[wall.motion]\ntimes = [0, 1, 1]\n"
         "places = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\n",
         4, 16, 1, "wall[0].motion.times[2]", "must ascend", ""},
        {"[[wall]]\nshape = \"plane\"\n[wall.motion]\ntimes = [0, 1]\nplaces = [[0, 0, 0], 1]\n", 5,
         22, 1, "wall[0].motion.places[1]", "expected a list of 3 numbers", ""},
        {"[[wall]]\nshape = \"plane\"\n[wall.motion]\ntimes = [0, 1]\n"
         "places = [[1, 0, 0], [1, 0, 0]]\n",
         5, 10, 22, "wall[0].motion.places", "not at [0, 0, 0] at time 0", ""},
        {"[[wall]]\nshape = \"plane\"\n[wall.motion]\nvelocity = [1, 0, 0]\n"
         "table = \"x.csv\"\n",
         4, 12, 9, "wall[0].motion.velocity", "give one of", ""},
        {"[[wall]]\nshape = \"plane\"\n[wall.motion]\npiston = { depth = 1 }\n", 4, 10, 13,
         "wall[0].motion.piston.solitary_height", "is missing", "Height"},
        {"[[wall]]\nshape = \"basin\"\nmin=[0,0,0]\nmax=[1,1,1]\nopen = [\"up\"]\n", 5, 9, 4,
         "wall[0].open[0]", "expected one of \"-x\"", ""},
        {"[[wall]]\nshape = \"basin\"\nmin=[0,0,0]\nmax=[1,1,1]\nopen = [\"+z\", \"+z\"]\n", 5, 15,
         4, "wall[0].open[1]", "\"+z\" is listed twice", "remove one"},
        {"[[wall]]\nshape = \"box\"\nmin=[0,0,0]\nmax=[1,1,1]\nradius = 3\n", 5, 1, 6,
         "wall[0].radius", "has no meaning with shape = \"box\"", "\"min\""},
        {"[[wall]]\nshape = \"cylinder\"\nradius = 1\nposition=[0,0,0]\n", 1, 1, 8,
         "wall[0].length", "is missing, it is needed with shape = \"cylinder\"", "Length"},
        {"[[wall]]\nname = \"a,b\"\nshape = \"plane\"\n", 2, 8, 5, "wall[0].name",
         "is not a valid name", ""},
        {"[[wall]]\nname = \"w\"\nshape = \"plane\"\n[[wall]]\nname = \"w\"\nshape = \"plane\"\n",
         5, 8, 3, "wall[1].name", "is used twice, first in line 10", ""},
        {"[[wall]]\nshape = "
         "\"sphere\"\nradius=1\nposition=[0,0,0]\nrotation_deg={axis=[0,0,0],angle=3}\n",
         5, 20, 7, "wall[0].rotation_deg.axis", "no direction", ""},
        {"[[wall]]\nshape = \"sphere\"\nradius=1\nposition=[0,0,0]\nrotation_deg={axis=[0,0,1]}\n",
         5, 14, 14, "wall[0].rotation_deg.angle", "is missing", ""},
        {"[[wall]]\nshape = \"sphere\"\nradius=1\nposition=[0,0,0]\nrotation=[1,1,0,0]\n", 5, 10, 9,
         "wall[0].rotation", "not a unit quaternion", ""},
        {sphere + "density = 500\n", 1, 1, 8, "body[0].radius", "is missing", ""},
        {sphere + "radius = 1\n", 1, 1, 8, "body[0].density", "give `density` or `mass`", ""},
        {sphere + "radius = 1\nmass = 1\ndensity = 1\n", 5, 8, 1, "body[0].mass", "not both", ""},
        {sphere + "radius = 1\nmass = 1\nshade = 1\n", 6, 1, 5, "body[0].shade", "unknown key",
         "\"shape\""},
        {sphere + "radius = 1\nmass = \"1 kg/m\"\n", 5, 8, 8, "body[0].mass",
         "has another dimension", ""},
        {sphere + "radius = 1\nmass = 1\nfixed = \"yes\"\n", 6, 9, 5, "body[0].fixed",
         "expected true or false", ""},
        {sphere + "radius = 1\nmass = 1\nfixed = true\nvelocity = [1,0,0]\n", 7, 12, 7,
         "body[0].velocity", "fixed body", ""},
        {sphere + "radius = 1\nmass = 1\nlocks = [\"q\"]\n", 6, 10, 3, "body[0].locks[0]",
         "expected one of \"x\"", ""},
        {sphere + "radius = 1\nmass = 1\nfixed = true\nlocks = [\"z\"]\n", 7, 9, 5, "body[0].locks",
         "fixed body", ""},
        {sphere + "radius = 1\nmass = 1\nvelocity = [0, 0, 1]\nlocks = [\"z\"]\n", 6, 12, 9,
         "body[0].velocity", "is not 0 along z, which is locked", ""},
        {sphere + "radius = 1\nmass = 1\nangular_velocity = [0, 2, 0]\nlocks = [\"ry\"]\n", 6, 20,
         9, "body[0].angular_velocity", "is not 0 about y, which is locked", ""},
        {sphere + "radius=1\nmass=1\n[body.copies]\ncount=[9999,9999,9999]\npitch=[1,1,1]\n", 7, 7,
         16, "body[0].copies.count", "too many", ""},
        {sphere + "radius=1\nmass=1\n[body.copies]\ncount=[2,1,1.5]\npitch=[1,1,1]\n", 7, 12, 3,
         "body[0].copies.count[2]", "expected a whole number", ""},
        {sphere + "radius=1\nmass=1\n[body.copies]\ncount=[2,1,0]\npitch=[1,1,1]\n", 7, 12, 1,
         "body[0].copies.count[2]", "0 is out of range, expected 1 .. 100000", ""},
        {sphere + "radius=1\nmass=1\n[body.copies]\ncount=[2,1,1]\npitch=[0,1,1]\n", 8, 7, 7,
         "body[0].copies.pitch", "copies along x would coincide", ""},
        {sphere + "radius=1\nmass=1\n[body.copies]\ncount=[2,1,1]\n", 6, 1, 13,
         "body[0].copies.pitch", "is missing", ""},
        {"[[body]]\nshape = \"cilinder\"\n", 2, 9, 10, "body[0].shape", "unknown \"cilinder\"",
         "did you mean \"cylinder\"?"},
        {"[[body]]\nshape = \"particles\"\nfile = \"none.csv\"\ndensity = 1\nposition = [0,0,0]\n",
         3, 8, 10, "body[0].file", "none.csv does not exist", "relative to the case file"},
        {"[[body]]\nshape = \"box\"\nsize=[1,0,1]\nmass=1\nposition=[0,0,0]\n", 3, 6, 7,
         "body[0].size", "must be > 0", ""},
        {"[[contact.pair]]\nmaterials = [\"pin\", \"oak\"]\n" + sphere +
             "radius=1\nmass=1\nmaterial=\"pine\"\n",
         2, 14, 5, "contact.pair[0].materials[0]", "no wall or body has the material \"pin\"",
         "did you mean \"pine\"?"},
        {"[[contact.pair]]\nmaterials = [\"pine\"]\n", 2, 13, 8, "contact.pair[0].materials",
         "expected 2 texts, found 1", ""},
        {"[[gauge]]\ntype = \"force\"\non = \"bod.1\"\n" + sphere + "radius=1\nmass=1\n", 3, 6, 7,
         "gauge[0].on", "no wall or body is named", "did you mean \"body.1\"?"},
        {"[[gauge]]\ntype = \"pressure\"\nat = [1, 2]\n", 3, 6, 6, "gauge[0].at",
         "expected 3 numbers", ""},
        {"[[gauge]]\ntype = \"pressure\"\n", 1, 1, 9, "gauge[0].at", "is missing", ""},
        {"[[gauge]]\ntype = \"pressure\"\nat = [1, 2, 3]\narea = 1\n", 1, 1, 9, "gauge[0].normal",
         "is missing", ""},
        {"[[gauge]]\ntype = \"flux\"\nat = [1, 2, 3]\nnormal = [0, 0, 0]\n", 4, 10, 9,
         "gauge[0].normal", "has no direction", ""},
        {"[[gauge]]\ntype = \"flux\"\nat = [1, 2, 3]\nnormal = [0, 0, 1e200]\n", 4, 10, 13,
         "gauge[0].normal", "has no direction", ""},
        {"[[gauge]]\ntype = \"front\"\nfilter = \"mean\"\n", 1, 1, 9, "gauge[0].window",
         "is missing", ""},
        {"[[gauge]]\ntype = \"front\"\nwindow = 1\n", 3, 1, 6, "gauge[0].window", "no meaning", ""},
        {"[[fluid.block]]\nshape = \"sphere\"\nradius = 1\nposition = [0, 0, 0]\n"
         "velocity_field = [\"x\", \"0\", \"t\"]\n",
         5, 18, 15, "fluid.block[1].velocity_field", "unknown name \"t\"", "x, y and z"},
        {"[[fluid.block]]\nshape = \"sphere\"\nradius = 1\nposition = [0, 0, 0]\n"
         "pressure_field = \"2*\"\n",
         5, 18, 4, "fluid.block[1].pressure_field", "is not an expression", ""},
        {"[[fluid.block]]\nshape = \"sphere\"\nradius = 1\nposition = [0, 0, 0]\n"
         "pressure_field = \"0,5\"\n",
         5, 18, 5, "fluid.block[1].pressure_field", "the decimal sign is a point", ""},
        {"[[fluid.block]]\nshape = \"sphere\"\nradius = 1\nposition = [0, 0, 0]\n"
         "pressure_field = \"z = 5\"\n",
         5, 18, 7, "fluid.block[1].pressure_field", "equality is written ==", ""},
        {"[[gauge]]\ntype = \"front\"\non = \"w\"\n", 3, 1, 2, "gauge[0].on",
         "has no meaning with type = \"front\"", ""},
        {"[fluid.viscosity]\nmodel = \"laminar\"\nalpha = 0.1\n", 3, 1, 5, "fluid.viscosity.alpha",
         "has no meaning with model = \"laminar\"", "kinematic"},
        {"[fluid.viscosity]\nkinematic = 1\n", 2, 1, 9, "fluid.viscosity.kinematic",
         "has no meaning with model = \"artificial\"", ""},
        {"[fluid.viscosity]\nmodel = \"sps\"\nalpha = 0.1\n", 3, 1, 5, "fluid.viscosity.alpha",
         "has no meaning with model = \"sps\"", ""},
        {"[fluid.collision]\nrestitution = 0.1\n", 2, 1, 11, "fluid.collision.restitution",
         "has no meaning with model = \"none\"", ""},
        {"[fluid.shifting]\nmodel = \"fickian\"\n", 2, 9, 9, "fluid.shifting.model", "\"fickian\"",
         ""},
        {"[fluid.density_diffusion]\nmodel = \"none\"\ndelta = 0.1\n", 3, 1, 5,
         "fluid.density_diffusion.delta", "has no meaning", ""},
    };
    for (const Mistake& m : all) {
        expect_found(m, mistakes(short_case + m.lines));
    }
}

TEST(CaseFileErrors, RecoveryNeedsAStepThatCanBeHalved)
{
    const auto all = mistakes("[time]\nend = 1\nstep = 0.1\nrecover = true\n");
    const Diagnostic d = mistake_at(all, "time.recover");
    EXPECT_EQ(d.line, 4);
    EXPECT_NE(d.hint.find("can be halved"), std::string::npos) << to_string(d);
}

TEST(CaseFileErrors, AllAreToldAtOnceInTheOrderOfTheFile)
{
    const auto all = mistakes(
        short_case + "[output]\nevry = 1\nhistory_every = -1\n[contact]\nfriction = \"a\"\n");
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].key, "output.evry");
    EXPECT_EQ(all[1].key, "output.history_every");
    EXPECT_EQ(all[2].key, "contact.friction");
    EXPECT_EQ(all[2].source, "friction = \"a\"");
}

TEST(CaseFileErrors, AMistakeDoesNotBringFalseOnes)
{
    EXPECT_EQ(mistakes(short_case +
                       "[[body]]\nshape = \"bx\"\nsize = [1,1,1]\nmass = 1\nposition = [0,0,0]\n")
                  .size(),
              1u);
    // What is right for any shape or gauge stays right beside a mistyped name.
    EXPECT_EQ(mistakes(short_case + "[[wall]]\nshape = \"bsin\"\nmin = [0,0,0]\nmax = [1,1,\"1 "
                                    "ft\"]\nopen = [\"+z\"]\nradius = -1\nnormal = [0, 0, 1]\n"
                                    "[wall.rotation_deg]\nangle = 1\n")
                  .size(),
              1u);
    EXPECT_EQ(mistakes(short_case + "[[gauge]]\ntype = \"presure\"\nat = [1, 2, 3]\n"
                                    "axis = \"x\"\n[[gauge]]\ntype = \"presure\"\nat = [1]\n")
                  .size(),
              2u);
    // Copies that cannot be counted have names, too.
    for (const char* copies : {"count = [2, 0, 1]\npitch = [2, 2, 2]\n", "count = [2, 1, 1]\n",
                               "count = [2, 2, 1]\npitch = [2, 0, 0]\n"}) {
        EXPECT_EQ(mistakes(short_case +
                           "[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.5\n"
                           "density = 500\nposition = [0, 0, 5]\n[body.copies]\n" +
                           copies + "[[gauge]]\ntype = \"force\"\non = \"b.2\"\n")
                      .size(),
                  1u)
            << copies;
    }
    EXPECT_EQ(mistakes(replaced(short_case, "end = 1", "end = \"1 m\"")).size(), 1u);
    EXPECT_EQ(mistakes(replaced(short_case, "spacing = 0.1", "spacing = 0")).size(), 1u);
}

TEST(CaseFileErrors, AnUnknownNameOfAShapeDoesNotHideOtherMistakes)
{
    // Of each of these keys a value of another kind, which no shape and no gauge takes.
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"size", "3"},           {"size", "[1, \"1 kg\", 1]"},
        {"radius", "true"},      {"radius", "\"1 s\""},
        {"length", "[1, 1, 1]"}, {"min", "\"low\""},
        {"max", "[1, 1, nan]"},  {"open", "[\"up\"]"},
        {"open", "\"+z\""},      {"normal", "1"},
        {"file", "3"},           {"scale", "\"large\""},
    };
    for (const std::string shape : {"bassin", "qqqqqqqq", ""}) {
        for (const auto& [key, value] : wrong) {
            const auto all = mistakes(short_case + "[[wall]]\nshape = \"" + shape + "\"\n" + key +
                                      " = " + value + "\n");
            SCOPED_TRACE(key + " = " + value);
            ASSERT_EQ(all.size(), 2u);
            EXPECT_EQ(all[0].key, "wall[0].shape");
            EXPECT_TRUE(all[1].key.starts_with("wall[0]." + key)) << to_string(all[1]);
        }
    }
    EXPECT_EQ(mistakes(short_case + "[[gauge]]\ntype = \"presure\"\nat = [1, 2, \"3 s\"]\n"
                                    "axis = 3\non = 1\narea = \"1 kg\"\n")
                  .size(),
              5u);
}

TEST(CaseFileErrors, UnknownKeysAreFoundInEveryTable)
{
    std::set<std::string> tables;
    for (const Parameter& parameter : parameters()) {
        if (parameter.kind == ValueKind::table || parameter.kind == ValueKind::tables) {
            tables.emplace(parameter.key);
        }
    }
    EXPECT_GE(tables.size(), 18u);
    for (const std::string& table : tables) {
        std::string path = table;
        // A ground is added below: the sixth wall.
        path = path.starts_with("wall[].level") ? "wall[5].level" : path;
        for (auto at = path.find("[]"); at != std::string::npos; at = path.find("[]", at + 1)) {
            // The last but one wall and the last block are those with a rotation.
            path.replace(at, 2,
                         path.starts_with("wall")    ? "[3]"
                         : path.starts_with("fluid") ? "[2]"
                                                     : "[0]");
        }
        const Parameter& parameter = *find_parameter(table);
        path += parameter.kind == ValueKind::tables ? "[0].zzzzzz=1" : ".zzzzzz=1";
        const std::string others = "\n[[sponge]]\n[[debris]]\n[debris.array]\n[debris.scatter]\n"
                                   "[[open]]\n[[open.station]]\n[[buildings]]\n"
                                   "[[wall]]\nshape = \"terrain\"\n[[wall.level]]\n";
        const auto all = mistakes(full_case + others, {path});
        const bool told = std::any_of(all.begin(), all.end(), [](const Diagnostic& d) {
            return d.what == "unknown key" && d.key.ends_with("zzzzzz");
        });
        EXPECT_TRUE(told) << path << "\n" << (all.empty() ? "" : to_string(all[0]));
    }
}

TEST(CaseFileErrors, WithoutFluidItsGaugesHaveNoMeaning)
{
    const std::string text =
        "[time]\nend=1\n[particles]\nspacing=1\n" + sphere + "radius=1\nmass=1\n";
    EXPECT_TRUE(mistakes(text).empty());
    for (const std::string type : {"elevation", "pressure", "velocity"}) {
        const auto all = mistakes(text + "[[gauge]]\ntype = \"" + type + "\"\nat = [0,0,0]\n");
        EXPECT_NE(mistake_at(all, "gauge[0].type").what.find("without fluid"), std::string::npos);
    }
    EXPECT_EQ(mistakes(text + "[[gauge]]\ntype = \"front\"\n").size(), 1u);
    EXPECT_TRUE(mistakes(text + "[[gauge]]\ntype = \"force\"\non = \"body.1\"\n").empty());
}

TEST(CaseFileErrors, MissingTablesAreNamed)
{
    const auto all = mistakes("[fluid]\n");
    EXPECT_NE(mistake_at(all, "time.end").what.find("is missing"), std::string::npos);
    EXPECT_NE(mistake_at(all, "particles.spacing").what.find("is missing"), std::string::npos);
    EXPECT_EQ(mistake_at(all, "fluid.block").line, 1);
    EXPECT_NE(
        mistakes("[time]\nend=1\n[particles]\nspacing=1\n")[0].what.find("nothing to simulate"),
        std::string::npos);
}

TEST(CaseFileErrors, RotationsInTwoDimensionsAreAboutY)
{
    const std::string text = "dimensions = 2\n" + short_case + sphere + "radius=1\nmass=1\n";
    EXPECT_TRUE(mistakes(text).empty());
    EXPECT_EQ(mistakes(text + "rotation_deg = {axis=[1,0,0], angle=3}\n").size(), 1u);
    EXPECT_EQ(mistakes(text + "angular_velocity = [1,0,0]\n").size(), 1u);
    EXPECT_EQ(mistakes(text + "rotation = [0.8,0.6,0,0]\n").size(), 1u);
}

// Their moments of inertia drown in rounding, and the first step gave no numbers.
TEST(CaseFileErrors, BodiesThinnerThanAMicrometreAreRefused)
{
    for (const char* thin :
         {"shape = \"sphere\"\nradius = 1e-308\n", "shape = \"box\"\nsize = [1, 1e-12, 1]\n",
          "shape = \"cylinder\"\nradius = 1e-9\nlength = 1\n"}) {
        const auto all = mistakes(short_case + "[[body]]\nposition = [0, 0, 5]\nmass = 1\n" + thin);
        ASSERT_EQ(all.size(), 1u) << thin;
        EXPECT_NE(mistake_at(all, "body[0].shape").what.find("thick, expected at least 1e-06 m"),
                  std::string::npos);
    }
    EXPECT_TRUE(mistakes(short_case + sphere + "radius = 1e-6\nmass = 1\n").empty());
}

TEST(CaseFileErrors, FrictionNeedsViscosity)
{
    EXPECT_TRUE(mistakes(short_case, {"fluid.walls=no_slip"}).empty());
    const auto all = mistakes(short_case, {"fluid.walls=no_slip", "fluid.viscosity.model=none"});
    EXPECT_EQ(mistake_at(all, "fluid.walls").what, "has no meaning without viscosity");
}

TEST(CaseFileErrors, OverridesAreNamedAsTheirPlace)
{
    const auto all =
        mistakes(short_case, {"fluid.density=-1", "fluid.densty=3", "nonsense", "wall[2].name=x",
                              "a[=3", "time.end.x=3", "time.end=[1", "title=1\nseed=2"});
    ASSERT_EQ(all.size(), 8u);
    for (const Diagnostic& d : all) {
        EXPECT_EQ(d.file.substr(0, 6), "--set ");
        EXPECT_EQ(d.line, 0);
    }
    EXPECT_EQ(mistake_at(all, "fluid.density").file, "--set fluid.density=-1");
    EXPECT_EQ(mistake_at(all, "fluid.densty").hint, "did you mean \"density\"?");
}

} // namespace hyoryu::test_case_file_errors
