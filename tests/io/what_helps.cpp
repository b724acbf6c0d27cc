#include "io/what_helps.hpp"

#include <gtest/gtest.h>

#include "core/state/monitors.hpp"

namespace riven {
namespace {

TEST(WhatHelps, LeavesOutWhatTheSceneHasAlready) {
  Scene s;
  s.stress_update = StressUpdate::usl;
  s.transfer = Transfer::pic;
  s.contact_rules.detection = ContactDetection::volume;
  s.cracks.resize(1);
  s.cracks[0].contact = s.contact;
  s.cracks[0].contact->law = ContactLaw::ignored;
  s.materials = {{"steel", LawKind::neo_hookean, 200e9, 0.3, 7850}, {"resin", LawKind::linear_elastic, 3e9, 0.3, 1200}};
  for (const auto& text : watched_texts)
    EXPECT_EQ(what_helps(text.advice, s), text.advice);
  EXPECT_EQ(what_helps("", s), "");

  s.transfer = Transfer::flip;
  EXPECT_EQ(what_helps(text_of(Watched::angular_momentum).advice, s), "smaller cells");
  s.transfer = Transfer::fmpm;
  EXPECT_EQ(what_helps(text_of(Watched::stretch).advice, s), "a larger particles_per_cell");
  const char* const orders = "a smaller solver.cfl; a solver.order of 4 or less";
  EXPECT_EQ(what_helps(orders, s), "a smaller solver.cfl");
  s.order = 8;
  EXPECT_EQ(what_helps(orders, s), orders);
  s.stress_update = StressUpdate::usavg;
  EXPECT_TRUE(what_helps(text_of(Watched::energy).advice, s).starts_with("a smaller solver.cfl; contact.law"));
  EXPECT_TRUE(what_helps(text_of(Watched::penetration).advice, s).starts_with("a contact.law that keeps"));
  s.cracks[0].contact.reset();
  EXPECT_TRUE(what_helps(text_of(Watched::penetration).advice, s).starts_with("contact.detection"));
  s.cracks.clear();
  EXPECT_EQ(what_helps(text_of(Watched::energy).advice, s), "a smaller solver.cfl");
  s.materials.pop_back();
  EXPECT_EQ(what_helps(text_of(Watched::compression).advice, s), "smaller cells or a smaller solver.cfl");
  s.contact_rules.detection = ContactDetection::displacement;
  EXPECT_EQ(what_helps(text_of(Watched::penetration).advice, s), "a smaller solver.cfl; smaller cells");
}

}  // namespace
}  // namespace riven
