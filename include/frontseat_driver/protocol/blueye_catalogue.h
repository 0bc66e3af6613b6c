#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frontseat_driver::protocol {

/// Every Blueye message by its name, for what goes through without a layout of its own: to and from
/// JSON, and field by field. The names of types are taken with and without `blueye.protocol.`.
///
/// Has a pool of descriptors of its own, so that it meets no other library's. Const calls may come
/// from several threads.
class BlueyeCatalogue {
 public:
  BlueyeCatalogue();
  ~BlueyeCatalogue();
  BlueyeCatalogue(const BlueyeCatalogue&) = delete;
  BlueyeCatalogue& operator=(const BlueyeCatalogue&) = delete;

  bool knows(std::string_view type) const;

  /// With the package.
  static std::string fullName(std::string_view type);

  /// Without the package, in alphabetical order: all that end in `end`, such as "Tel".
  std::vector<std::string> names(std::string_view end) const;

  /// What came of a conversion.
  struct Result {
    bool ok = false;
    std::string text;  ///< the result, or why there is none
  };

  /// The message's bytes. `json` as protobuf writes it, with the names of the fields as they are in
  /// the protocol; empty: all defaults. Refused: types and fields that do not exist, and numbers
  /// that are NaN or infinite.
  Result fromJson(std::string_view type, const std::string& json) const;

  /// All fields, also those that have their default, on one line. What google.protobuf.Any holds is
  /// written out where its type is known.
  Result toJson(std::string_view type, std::string_view bytes) const;

  /// Every field that is there and no message, in order: its path ("voltage.cell_1") and its value
  /// as text. Elements of lists have their index ("cpu_cores[0].load"). Empty if the bytes are not
  /// of the type.
  std::vector<std::pair<std::string, std::string>> values(std::string_view type,
                                                          std::string_view bytes) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::protocol
