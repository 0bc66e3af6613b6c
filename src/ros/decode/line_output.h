#pragma once

#include <cstdio>

#include "output.h"

namespace frontseat_driver::decode {

/// A line for each sentence, to be read: time, `<` from or `>` to the vehicle, sentence, fields
/// with names and units. What is wrong stands below it, with a mark under the place.
class LineOutput : public Output {
 public:
  explicit LineOutput(std::FILE* stream) : sink_(stream, "standard output") {}

  void write(const DecodedLine& line) override;
  void flush() override { sink_.flush(); }

 private:
  TextSink sink_;
};

}  // namespace frontseat_driver::decode
