#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frontseat_driver::bench {

/// A named run of sentences, each with checksum, CR and LF.
struct Sample {
  std::string name;
  std::string bytes;
  std::size_t sentences = 0;

  double bytesEach() const { return static_cast<double>(bytes.size()) / double(sentences); }
};

/// What both vehicles send, in the proportions of their rates, 75 bytes each on average. Digits are
/// drawn at random and written as the vehicles in test/captures write them, so that no branch
/// predictor learns them by heart; the same ones each time.
Sample vehicleMix(std::size_t sentences);

/// The same kind of sentence over and over, with other digits. `type` is one of types().
Sample onlyOf(std::string_view type, std::size_t sentences);

std::vector<std::string_view> types();

}  // namespace frontseat_driver::bench
