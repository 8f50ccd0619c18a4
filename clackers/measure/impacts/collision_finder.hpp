#pragma once

#include <optional>

#include "clackers/model/trajectory.hpp"

namespace clackers::measure {

/// The history with both limits of its reported impacts as two rows of one time, or nothing where
/// no row is to be added. A row that stands alone at the time of an impact is replaced by them;
/// two rows stay as they are. Of several impacts at one time the first gives the left limit and the
/// last the right one.
///
/// An impact is used only if its time lies within the history and it carries the displacement and
/// both velocities of every mass, finite. A history with accelerations or without velocities stays
/// as it is, since an impact does not carry accelerations.
std::optional<model::Trajectory> with_jump_limits(const model::Trajectory& history);

}  // namespace clackers::measure
