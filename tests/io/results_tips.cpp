// What is written of the tips of cracks: events as they happen, columns of the history, entries of the summary.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "io/crack_opening.hpp"
#include "io/crack_paths.hpp"
#include "io/event_log.hpp"
#include "io/tip_report.hpp"

using namespace riven;

namespace {

Cracks two_cracks() {
  Scene scene;
  for (const double y : {1., 2.}) {
    CrackLine line;
    line.name = y == 1 ? "low" : "high";
    line.points = {{0, y}, {3, y}};
    scene.cracks.push_back(line);
  }
  return make_cracks(scene, 1);
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

TEST(ResultsTips, EventsAreWrittenAsTheyHappenAndOnce) {
  const auto path = std::filesystem::temp_directory_path() / "riven_events.csv";
  const Cracks cracks = two_cracks();
  std::vector<CrackEvent> events;
  {
    EventLog log(path);
    EXPECT_EQ(lines_of(path).size(), 1u);
    CrackEvent e;
    e.step = 7;
    e.time = 0.5;
    e.last = true;
    e.place = {3, 1};
    e.J = 100;
    e.K_I = 2e6;
    e.load = 1.0625;
    events.push_back(e);
    log.write(events, cracks);
    EXPECT_EQ(lines_of(path).size(), 2u);
    log.write(events, cracks);
    EXPECT_EQ(lines_of(path).size(), 2u);
    e.kind = CrackEvent::Kind::join;
    e.crack = 1;
    e.last = false;
    e.other = 0;
    events.push_back(e);
    e.kind = CrackEvent::Kind::arrest;
    events.push_back(e);
    log.write(events, cracks);
  }
  const std::vector<std::string> lines = lines_of(path);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0],
            "time [s],step,crack,end,event,x [m],y [m],other crack,K_I [Pa m^0.5],K_II [Pa m^0.5],J [J/m^2],"
            "speed [m/s],load [1]");
  EXPECT_EQ(lines[1], "0.5,7,low,last,start,3,1,,2000000,0,100,0,1.0625");
  EXPECT_EQ(lines[2], "0.5,7,high,first,join,3,1,low,2000000,0,100,0,1.0625");
  EXPECT_NE(lines[3].find(",arrest,"), std::string::npos);
  std::filesystem::remove(path);
}

TEST(ResultsTips, NamesWithCommasStayOneField) {
  const auto path = std::filesystem::temp_directory_path() / "riven_events_names.csv";
  Cracks cracks = two_cracks();
  cracks.names[0] = "left, \"old\"";
  {
    EventLog log(path);
    log.write({CrackEvent{}}, cracks);
  }
  EXPECT_NE(lines_of(path).at(1).find(",\"left, \"\"old\"\"\",first,"), std::string::npos);
  std::filesystem::remove(path);
}

TEST(ResultsTips, EventsThatCannotBeWrittenAreAFileError) {
  try {
    EventLog log("no/such/folder/events.csv");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::file);
  }
  EXPECT_THROW(EventLog("/dev/full"), Error);
}

TEST(ResultsTips, HaveColumnsUpToAReasonableNumber) {
  const Cracks cracks = two_cracks();
  std::vector<Tip> tips(3);
  tips[1].crack = 1;
  tips[1].last = true;
  tips[1].length = 0.5;
  tips[1].J = 9;
  tips[1].K_I = 3;
  tips[1].K_II = -1;
  tips[1].speed = 7;
  tips[1].grows = true;
  tips[1].drive_I = 4;
  tips[1].load = 0.75;
  Scene scene;
  scene.cracks.resize(2);
  scene.growth = GrowthRule{};
  scene.growth->criterion = GrowthCriterion::k_max;
  scene.growth->toughness = 5;
  const std::vector<HistoryColumn> columns = tip_columns(tips, cracks);
  std::vector<double> row;
  add_tip_values(scene, tips, cracks, row);
  ASSERT_EQ(columns.size(), 22u);
  ASSERT_EQ(row.size(), 22u);
  EXPECT_EQ(columns[7].name, "high last x");
  EXPECT_EQ(columns[10].unit, "J/m^2");
  const Vec2 end = cracks.plane[cracks.end_point(1, true)];
  EXPECT_EQ(columns[14].name, "high last load");  // of the one that grows
  EXPECT_EQ((std::vector<double>{row.begin() + 7, row.begin() + 15}),
            (std::vector<double>{end.x, end.y, 0.5, 9, 3, -1, 7, 0.75}));
  tips[1].length = 0;
  row.clear();
  add_tip_values(scene, tips, cracks, row);
  EXPECT_EQ(row[14], 0.8);  // one that has not grown goes by what drives it now
  const std::vector<HistoryColumn> far = reading_columns({"far", {}}, tips, cracks);
  row.clear();
  add_reading_values(tips, row);
  ASSERT_EQ(far.size(), 9u);
  ASSERT_EQ(row.size(), 9u);
  EXPECT_EQ(far[3].name, "high last far J");
  EXPECT_EQ((std::vector<double>{row.begin() + 3, row.begin() + 6}), (std::vector<double>{9, 3, -1}));
  tips.resize(400);
  row.clear();
  add_tip_values(scene, tips, cracks, row);
  EXPECT_EQ(row.size(), 7 * most_tip_columns + 1);
  EXPECT_EQ(tip_columns(tips, cracks).size(), row.size());
}

TEST(ResultsTips, AreAllInTheSummary) {
  const Cracks cracks = two_cracks();
  std::vector<Tip> tips(60);
  tips[0].last = tips[0].running = true;
  tips[0].step = 3;
  tips[0].M_I = 5;
  tips[0].reach[0] = 2.25;
  tips[0].reach[1] = tips[0].reach[2] = tips[0].reach[3] = 2;
  tips[1].crack = 1;
  tips[1].open = false;
  const Scene scene;
  const std::vector<Summary::Tip> list = summarize_tips(scene, tips, cracks);
  ASSERT_EQ(list.size(), 60u);
  EXPECT_EQ(list[0].crack, "low");
  EXPECT_EQ(list[0].end, "last");
  EXPECT_EQ(list[0].state, "running");
  EXPECT_EQ(list[0].x, 3);
  EXPECT_EQ(list[0].y, 1);
  EXPECT_EQ(list[0].M_I, 5);
  EXPECT_EQ(list[0].contour, "4.25 x 4 cells");
  EXPECT_EQ(list[1].state, "closed");
  EXPECT_EQ(list[1].x, 0);
  EXPECT_EQ(list[2].state, "resting");
  EXPECT_EQ(list[2].contour, "");
}

TEST(ResultsTips, PathsOfCracksAreATableOfTheirPoints) {
  const auto path = std::filesystem::temp_directory_path() / "riven_crack_paths.csv";
  Cracks cracks = two_cracks();
  cracks.names[1] = "second, \"B\"";
  const int end = cracks.end_point(1, true);
  cracks.plane[end] = {3.25, 1.5};
  cracks.upper[end] = {3.125, 1.75};
  cracks.lower[end] = {3.375, 1.25};
  write_crack_paths(path, cracks);
  const auto lines = lines_of(path);
  ASSERT_EQ(lines.size(), 1u + static_cast<std::size_t>(cracks.points()));
  EXPECT_EQ(lines[0], "crack,point,x [m],y [m],first x [m],first y [m],opening [m],sliding [m]");
  EXPECT_EQ(lines[1], "low,0,0,1,0,1,0,0");
  const CrackOpening o = crack_openings(cracks).back();
  EXPECT_GT(o.normal, 0.1);
  EXPECT_LT(o.sliding, -0.1);
  EXPECT_EQ(lines.back(), fmt::format("\"second, \"\"B\"\"\",{},3.25,1.5,3,2,{:.17g},{:.17g}",
                                      end - cracks.end_point(1, false), o.normal, o.sliding));
  std::filesystem::remove(path);
}

}  // namespace
