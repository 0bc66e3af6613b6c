#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/sim/quirks.h"

namespace frontseat_driver::sim {

/// A finished sentence taken apart, to be written as a real vehicle would rather than by the book.
class EditableSentence {
 public:
  /// `sentence` as a SentenceWriter finishes it, with its line end.
  explicit EditableSentence(std::string_view sentence);

  std::string_view formatter() const;

  /// Field by its number in the documents, from 1; nothing if the sentence is shorter.
  std::string* field(std::size_t number);
  void erase(std::size_t number);

  /// Put together again, with its checksum and `line_end`.
  std::string render(std::string_view line_end) const;

 private:
  std::vector<std::string> fields_;  ///< the address first
};

/// Whether any quirk needs rewrite().
bool rewrites(const Quirks& quirks);

/// The sentence with those quirks that an encoder cannot write. `standing`: the vehicle does not
/// move.
std::string rewrite(std::string_view sentence, const Quirks& quirks, bool standing);

}  // namespace frontseat_driver::sim
