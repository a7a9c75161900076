// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "mesh/primitives.h"

namespace exemplar {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

Json reportNamed(const std::string& title) {
  return {{"kind", "result"},           {"title", title},
          {"description", title},       {"example", {{"view", "example"}, {"picture", "example"}}},
          {"camera", {{"azimuth", 0}}}, {"notes", {title}},
          {"runs", Json::array()}};
}

/// The text between the first `open` after `from` and the next `close`.
std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t begin = text.find(open);
  if (begin == std::string::npos) return "";
  const std::size_t at = begin + open.size();
  return text.substr(at, text.find(close, at) - at);
}

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(ReportPage, HoldsItsReport) {
  const Json report = reportNamed("ruins");
  const std::string html = ReportPage().html(report);
  EXPECT_EQ(Json::parse(between(html, "id=\"report\">", "</script>")), report);
  EXPECT_THAT(html, HasSubstr("<title>ruins"));
  EXPECT_EQ(html, ReportPage().html(report));
}

TEST(ReportPage, ShowsHostileNamesAndRunsNone) {
  const std::string hostile = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'";
  const int scripts = count(ReportPage().html(reportNamed("ruins")), "<script");
  ReportPage page;
  page.addPicture(hostile, Image8{1, 1, 3, {1, 2, 3}});
  page.addView(hostile, "{\"data\":\"</script>\"}");
  const std::string html = page.html(reportNamed(hostile));
  // One script more: the view's.
  EXPECT_EQ(count(html, "<script"), scripts + 1);
  EXPECT_EQ(count(html, "</script"), scripts + 1);
  EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
  EXPECT_EQ(Json::parse(between(html, "id=\"report\">", "</script>")).at("title"), hostile);
}

TEST(ReportPage, TakesNamesThatAreNotText) {
  const std::string html = ReportPage().html(reportNamed("\xff\xfe ruins"));
  EXPECT_THAT(html, HasSubstr("<title>\xEF\xBF\xBD\xEF\xBF\xBD ruins"));
  EXPECT_TRUE(Json::accept(between(html, "id=\"report\">", "</script>")));
}

TEST(ReportPage, AsksForNothingFromElsewhere) {
  ReportPage page;
  page.addPicture("example", Image8{2, 1, 3, {1, 2, 3, 4, 5, 6}});
  const std::string html = page.html(reportNamed("ruins"));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  const std::regex elsewhere(R"((src|href)\s*=\s*["']?(https?:|//))");
  EXPECT_FALSE(std::regex_search(html, elsewhere));
  const std::string bad = "<script src=\"https://example.com/a.js\">";
  EXPECT_TRUE(std::regex_search(bad, elsewhere));
}

TEST(ReportPage, KnowsHowLongItWillBe) {
  ReportPage page;
  const std::size_t before = page.bytes();
  page.addView("example", std::string(100000, 'x'));
  EXPECT_EQ(page.bytes(), before + 100000);
  EXPECT_GE(page.html(reportNamed("ruins")).size(), page.bytes());
}

TEST(ReportPage, NamesThreesLicenseWhereItHoldsThree) {
  const std::string html = ReportPage().html(reportNamed("ruins"));
  EXPECT_EQ(html.find("three.js authors") != std::string::npos, reportsTurn());
}

TEST(ViewPart, IsJsonThatTellsItsSizes) {
  const ViewMesh view = makeViewMesh({makeSphere({0, 0, 0}, 1, 10)});
  const Json part = Json::parse(viewPart(view));
  EXPECT_EQ(part.at("triangles"), view.triangles.size());
  EXPECT_EQ(part.at("vertices"), view.vertices.size());
  EXPECT_EQ(part.at("box")[0][2], view.box.min.z);
  EXPECT_EQ(part.at("floor").at("side"), ViewFloor::kSide);
}

TEST(MarksAsJson, HaveAPlaceOnlyWhereTheyAreSeen) {
  Mark seam{Mark::Kind::Seam, 0, {1, 2, 3}, 2.5};
  seam.at = {0.25, 0.75};
  Mark copy{Mark::Kind::Copy, 1, {4, 5, 6}, 0.5};
  copy.outline = {{0, 0}, {1, 0}, {0, 1}};
  const Json json = toJson({seam, copy});
  EXPECT_EQ(json[0].at("kind"), "seam");
  EXPECT_EQ(json[0].at("at"), Json({0.25, 0.75}));
  EXPECT_FALSE(json[0].contains("outline"));
  EXPECT_EQ(json[1].at("kind"), "copy");
  EXPECT_TRUE(json[1].at("at").is_null());
  EXPECT_EQ(json[1].at("outline").size(), 3u);
}

}  // namespace
}  // namespace exemplar
