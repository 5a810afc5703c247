// SPDX-License-Identifier: BSD-3-Clause
#include "session/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "support/error.h"
#include "support/infinity.h"

namespace carreau {
namespace {

template <typename Body>
std::string sentence_of(Body&& body) {
  try {
    body();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "no error";
}

// RT-0232 fig. 13, without the action `call`; reals relative to diag have the divisor.
TEST(ParameterTable, HasEveryVariableOfFigure13WithItsDefault) {
  const Parameters defaults;
  for (const char* name : {"CheckAdjacentEdges", "CheckCloseEdges", "CheckWellDefined", "flag", "hgeo_flag",
                           "hinterpol_flag", "hmean_flag"})
    EXPECT_EQ(defaults.integer(name), 0) << name;
  for (const char* name : {"frontal", "hphy_flag", "refs"}) EXPECT_EQ(defaults.integer(name), 1) << name;
  EXPECT_EQ(defaults.integer("verb"), 10);
  const std::map<std::string, double> reals = {
      {"CoefRectangle", 0.25}, {"LSS", 0.5}, {"angle_mesh", 8}, {"angle_smo", 1}, {"eps_collapse", 0}};
  for (const auto& [name, value] : reals) EXPECT_EQ(defaults.real(name), value) << name;
  const double diag = 7.7;
  const std::map<std::string, double> divisors = {{"eps_ends", 500}, {"eps_glue", 500}, {"hgeomax", 5},
                                                  {"hgeomin", 500},  {"hphydef", 50},   {"hphymax", 5},
                                                  {"hphymin", 500}};
  for (const auto& [name, divisor] : divisors) {
    EXPECT_NEAR(defaults.real(name, diag), diag / divisor, 1e-15 * diag) << name;
    EXPECT_TRUE(find_parameter(name)->diag_relative) << name;
    EXPECT_TRUE(std::isnan(defaults.real(name))) << name;
  }
  const std::map<std::string, std::string> texts = {
      {"element", "p1"}, {"format", "mesh"}, {"option", ""}, {"pref", "x"}};
  for (const auto& [name, value] : texts) EXPECT_EQ(defaults.text(name), value) << name;
  EXPECT_EQ(find_parameter("call"), nullptr);
}

TEST(ParameterTable, IsSortedAndEveryDefaultIsAllowed) {
  const auto table = parameter_table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    const ParameterInfo& info = table[i];
    SCOPED_TRACE(info.name);
    if (i > 0) {
      EXPECT_LT(std::string(table[i - 1].name), std::string(info.name));
    }
    EXPECT_EQ(find_parameter(info.name), &info);
    EXPECT_GT(std::string(info.help).size(), 10u);
    EXPECT_EQ(std::string(info.help).find('\n'), std::string::npos);
    Parameters parameters;
    if (info.type == ParameterType::integer)
      EXPECT_NO_THROW(parameters.set(info.name, int(info.default_number)));
    else if (info.type == ParameterType::real)
      EXPECT_NO_THROW(parameters.set(info.name, info.default_number));
    else
      EXPECT_NO_THROW(parameters.set(info.name, std::string_view(info.default_text)));
  }
}

TEST(Parameters, KeepValuesUntilTheyAreReset) {
  Parameters parameters;
  parameters.set("hphydef", 0.25);
  parameters.set("hphymax", 3);  // an integer is a number
  parameters.set("flag", 1);
  parameters.set("option", "smo3d");
  EXPECT_EQ(parameters.real("hphydef", 100), 0.25);
  EXPECT_EQ(parameters.real("hphymax", 100), 3);
  EXPECT_EQ(parameters.integer("flag"), 1);
  EXPECT_EQ(parameters.text("option"), "smo3d");
  parameters.reset("hphydef");
  EXPECT_FALSE(parameters.is_set("hphydef"));
  EXPECT_EQ(parameters.real("hphydef", 100), 2);
  EXPECT_TRUE(parameters.is_set("flag"));
  parameters.reset_all();
  for (const ParameterInfo& info : parameter_table()) EXPECT_FALSE(parameters.is_set(info.name)) << info.name;
}

TEST(Parameters, EffortSetsItsSynonymsUntilTheyAreSetThemselves) {
  const std::map<std::string, std::array<int, 4>> levels = {{"crossing_rounds", {0, 0, 10, 20}},
                                                            {"shape_trials", {0, 0, 1, 1}},
                                                            {"certify", {1, 0, 1, 2}},
                                                            {"measure_bounds", {1, 0, 1, 2}},
                                                            {"measure_distances", {1, 0, 1, 1}}};
  for (const ParameterInfo& info : parameter_table())
    EXPECT_STREQ(info.set_by, levels.contains(info.name) ? "effort" : "") << info.name;
  for (const auto& [name, values] : levels) {
    SCOPED_TRACE(name);
    Parameters parameters;
    EXPECT_EQ(parameters.integer(name), values[0]);
    for (int effort = -1; effort <= 2; ++effort) {
      parameters.set("effort", effort);
      EXPECT_EQ(parameters.integer(name), values[std::size_t(effort + 1)]);
      EXPECT_FALSE(parameters.is_set(name));
    }
    parameters.set(name, 1);
    parameters.set("effort", 0);  // the order does not count
    EXPECT_EQ(parameters.integer(name), 1);
    parameters.reset(name);
    EXPECT_EQ(parameters.integer(name), values[1]);
  }
}

TEST(Parameters, TheManualsTwoWordsForOneSizeAreOne) {
  Parameters parameters;
  parameters.set("hphymmin", 0.25);  // RT-0232 fig. 13
  EXPECT_EQ(parameters.real("hphymin", 1), 0.25);
  EXPECT_EQ(find_parameter("hphymmin"), find_parameter("hphymin"));
}

TEST(Parameters, UnknownNamesGetTheNearestOne) {
  Parameters parameters;
  const auto sentence = [&](const char* name) { return sentence_of([&] { parameters.set(name, 1); }); };
  EXPECT_EQ(sentence("hphymminn"), "there is no parameter 'hphymminn'; did you mean 'hphymin'?");
  EXPECT_EQ(sentence("Hphydef"), "there is no parameter 'Hphydef'; did you mean 'hphydef'?");
  EXPECT_EQ(sentence("checkcloseedge"), "there is no parameter 'checkcloseedge'; did you mean 'CheckCloseEdges'?");
  EXPECT_EQ(sentence("temperature"), "there is no parameter 'temperature'");
  EXPECT_EQ(sentence("call"), "'call' is an action of blsurf.env, not a parameter");
  EXPECT_EQ(sentence(""), "there is no parameter ''");
  EXPECT_EQ(nearest_parameter(std::string(1000000, 'h')), "");
}

TEST(Parameters, RejectOtherTypes) {
  Parameters parameters;
  EXPECT_EQ(sentence_of([&] { parameters.set("flag", 0.5); }), "parameter flag is an integer, not the real number 0.5");
  EXPECT_EQ(sentence_of([&] { parameters.set("pref", 3); }), "parameter pref is a text, not the number 3");
  EXPECT_EQ(sentence_of([&] { parameters.set("hphydef", "big"); }),
            "parameter hphydef is a number, not the text 'big'");
  EXPECT_EQ(sentence_of([&] { (void)parameters.integer("hphydef"); }), "parameter hphydef is a number, not an integer");
  EXPECT_EQ(sentence_of([&] { (void)parameters.real("pref"); }), "parameter pref is a text, not a number");
  EXPECT_EQ(sentence_of([&] { (void)parameters.text("flag"); }), "parameter flag is an integer, not a text");
}

TEST(Parameters, RejectValuesOutOfRangeAndKeepTheOldOne) {
  Parameters parameters;
  parameters.set("hmean_flag", 1);
  EXPECT_EQ(sentence_of([&] { parameters.set("hmean_flag", -2); }),
            "parameter hmean_flag must be between -1 and 2; -2 is not");
  EXPECT_EQ(parameters.integer("hmean_flag"), 1);
  EXPECT_EQ(sentence_of([&] { parameters.set("hphydef", 0); }), "parameter hphydef must be greater than 0; 0 is not");
  EXPECT_EQ(sentence_of([&] { parameters.set("eps_glue", -1); }), "parameter eps_glue must be at least 0; -1 is not");
  EXPECT_EQ(sentence_of([&] { parameters.set("hphydef", std::nan("")); }),
            "parameter hphydef must be a finite number; nan is not");
  EXPECT_EQ(sentence_of([&] { parameters.set("hphydef", infinity); }),
            "parameter hphydef must be a finite number; inf is not");
  EXPECT_EQ(sentence_of([&] { parameters.set("element", "q1"); }), "parameter element must be 'p1', 'p2', 'q1.0', 'q1.1', 'q2.0' or 'q2.1'; 'q1' is not");
  EXPECT_EQ(sentence_of([&] { parameters.set("option", "all"); }),
            "parameter option must be '', 'allsurf3d', 'allsurf2d', 'onesurf3d', 'onesurf2d' or 'smo3d'; 'all' is not");
  EXPECT_EQ(sentence_of([&] { parameters.set("pref", ""); }), "parameter pref must not be empty");
}

TEST(Parameters, ReadWordsOfBlsurfEnv) {
  Parameters parameters;
  parameters.set_from_text("hphydef", "1.5d-1", false);
  parameters.set_from_text("hphymax", "2", false);
  parameters.set_from_text("frontal", "0", false);
  parameters.set_from_text("option", "onesurf2d", false);
  parameters.set_from_text("pref", "2", true);
  EXPECT_EQ(parameters.real("hphydef"), 0.15);
  EXPECT_EQ(parameters.real("hphymax"), 2);
  EXPECT_EQ(parameters.integer("frontal"), 0);
  EXPECT_EQ(parameters.text("option"), "onesurf2d");
  EXPECT_EQ(parameters.text("pref"), "2");
  parameters.set_from_text("option", "", true);
  EXPECT_EQ(parameters.text("option"), "");
  EXPECT_EQ(sentence_of([&] { parameters.set_from_text("frontal", "1.", false); }),
            "parameter frontal is an integer, not '1.'");
  EXPECT_EQ(sentence_of([&] { parameters.set_from_text("hphydef", "1,5", false); }),
            "parameter hphydef is a number, not '1,5'");
  EXPECT_EQ(sentence_of([&] { parameters.set_from_text("hphydef", "1.5", true); }),
            "parameter hphydef is a number, not the text '1.5'");
  EXPECT_EQ(sentence_of([&] { parameters.set_from_text("frontal", "99999999999", false); }),
            "parameter frontal is an integer, not '99999999999'");
}

TEST(Parameters, SentencesQuoteLongWordsInPart) {
  const std::string endless(100'000, 'x');
  Parameters parameters;
  for (const auto& row : {std::pair{endless, std::string("1")}, {"hphydef", endless}, {"threads", endless}}) {
    const std::string sentence = sentence_of([&] { parameters.set_from_text(row.first, row.second, false); });
    EXPECT_NE(sentence, "no error");
    EXPECT_LT(sentence.size(), 200U);
  }
}

}  // namespace
}  // namespace carreau
