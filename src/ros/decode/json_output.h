#pragma once

#include <cstdio>

#include "output.h"

namespace frontseat_driver::decode {

/// One JSON object a line:
///
///     {"time_s":1416410000.123,"direction":"rx","sentence":"BFNVG","fields":{"sent_at_s":43200,…}}
///
/// Names end with their unit; times of day are seconds since midnight; a blank field is null. A
/// record without times has no `time_s`. What is wrong is in `fault`; a bad or unknown line has no
/// `fields`, but the `line` itself, its bytes read as Latin-1.
class JsonOutput : public Output {
 public:
  explicit JsonOutput(std::FILE* stream) : sink_(stream, "standard output") {}

  void write(const DecodedLine& line) override;
  void flush() override { sink_.flush(); }

 private:
  TextSink sink_;
};

}  // namespace frontseat_driver::decode
