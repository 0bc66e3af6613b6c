#pragma once

#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "output.h"

namespace frontseat_driver::decode {

/// A table for each kind of sentence: `time_s`, `sentence`, its fields with their units, `fault`.
///
/// In a folder, a file for each, such as NVG.csv for BFNVG and CPNVG; what is unknown or bad is in
/// unknown.csv and bad.csv with its line. Files that are there already are replaced. Times of day
/// are seconds since midnight, and a blank field is empty.
class CsvOutput : public Output {
 public:
  /// Makes the folder if need be. Throws std::system_error that names it.
  explicit CsvOutput(const std::string& folder);

  /// One kind of sentence, to a stream; bad and unknown lines are left out.
  explicit CsvOutput(std::FILE* stream);

  CsvOutput(const CsvOutput&) = delete;
  CsvOutput& operator=(const CsvOutput&) = delete;
  ~CsvOutput() override;

  void write(const DecodedLine& line) override;
  void flush() override;

 private:
  struct Table;

  Table& tableFor(const DecodedLine& line);
  std::unique_ptr<Table> open(const std::string& name) const;

  std::string folder_;
  std::FILE* stream_ = nullptr;
  std::map<std::string, std::unique_ptr<Table>, std::less<>> tables_;  ///< by name
};

}  // namespace frontseat_driver::decode
