#include "diagnosis/transition_log.h"

#include <algorithm>
#include <cctype>

namespace frontseat_driver::ros_layer {

namespace {

std::string withoutFigures(std::string text) {
  const auto figure = [](unsigned char c) { return std::isdigit(c) != 0 || c == '.' || c == '-'; };
  text.erase(std::remove_if(text.begin(), text.end(), figure), text.end());
  return text;
}

}  // namespace

std::vector<TransitionLog::Line> TransitionLog::take(const Diagnoses& diagnoses,
                                                     vehicle::SteadyTime now) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    const Diagnosis& diagnosis = diagnoses[i];
    Told& told = told_[i];
    const bool well = diagnosis.level == Diagnosis::Level::Ok;
    const std::string complaint = well ? "" : withoutFigures(diagnosis.message);
    const bool too_soon = told.at && now - *told.at < kAtMostEvery;
    if (!kLayers[i].logged || !diagnosis.known || complaint == told.complaint || too_soon) continue;
    told = {complaint, now};
    lines.push_back({diagnosis.level, std::string{kLayers[i].name} + ": " +
                                          (well ? "well again, " : "") + diagnosis.message});
  }
  return lines;
}

}  // namespace frontseat_driver::ros_layer
