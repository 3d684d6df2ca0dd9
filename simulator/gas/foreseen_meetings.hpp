#pragma once
// What bodies with a prescribed motion will do at the walls of the box, or to each other, that ends a run: known before it
// begins.

#include <cstddef>
#include <string>
#include <vector>

#include "simulator/config.hpp"

namespace brisance::simulator::gas {

struct ForeseenMeeting {
  enum class Kind {
    runs_into_wall,    // comes within half a cell of it: the gas between has nowhere to go
    lets_go_of_wall,   // was at the wall and moves off: there is no gas that could widen into the room behind it
    runs_into_body,    // meets another body within the box; not if they touch at the start
    slides_along_body  // touches another body at the start, and one of them moves or is driven
  };
  std::string body, side;  // by their names in the case; `side` is the other body, where one runs into it
  Kind kind;
  double time;     // s
  double missing;  // m, by which a body that lets go of a wall should reach farther beyond it, to the end of the case
};

/// In the order of bodies and sides, then of pairs of bodies; looks at the motion up to the end of the case. Where bodies go
/// that the gas drives is not known: they are seen at the start alone. Empty without gas.
std::vector<ForeseenMeeting> foreseen_meetings(const Case& c);

/// What happens and what to do.
std::string in_words(const ForeseenMeeting& meeting);

}  // namespace brisance::simulator::gas
