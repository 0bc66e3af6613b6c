#include "src/link/endpoint.h"

#include <gtest/gtest.h>

#include <boost/asio/error.hpp>
#include <string>

namespace frontseat_driver::link::testing {
namespace {

using boost::system::error_code;

struct Host {
  const char* name;
  const char* host;
  const char* endpoint;  ///< empty: it is a name that has to be looked up
};

const Host kHosts[] = {{"ipv4", "192.168.1.101", "192.168.1.101:29500"},
                       {"ipv6", "fe80::1", "[fe80::1]:29500"},
                       {"ipv6_in_brackets", "[fe80::1]", "[fe80::1]:29500"},
                       {"name", "vehicle", ""},
                       {"nothing", "", ""},
                       {"one_letter", "b", ""},
                       {"ipv4_too_short", "192.168.1", ""},
                       {"brackets_alone", "[]", ""},
                       {"bracket_not_closed", "[fe80::1", ""},
                       {"bracket_not_opened", "fe80::1]", ""}};

class Numeric : public ::testing::TestWithParam<Host> {};

TEST_P(Numeric, IsAnAddressOrNone) {
  const auto endpoint = numericEndpoint(GetParam().host, 29500);
  EXPECT_EQ(endpoint ? toText(*endpoint) : "", GetParam().endpoint);
}

INSTANTIATE_TEST_SUITE_P(Table, Numeric, ::testing::ValuesIn(kHosts),
                         [](const auto& row) { return std::string{row.param.name}; });

/// Errors whose text is as a library of the system may have it.
class Wording : public boost::system::error_category {
 public:
  explicit Wording(const char* text) : text_(text) {}
  const char* name() const noexcept override { return "wording"; }
  std::string message(int) const override { return text_; }

 private:
  const char* text_;
};

TEST(ErrorText, SaysWhatTheVehicleDidWhereThatIsKnown) {
  namespace error = boost::asio::error;
  EXPECT_EQ(toText(error_code(error::eof)), "vehicle closed the connection");
  EXPECT_EQ(toText(error_code(error::connection_reset)), "vehicle reset the connection");
  EXPECT_EQ(toText(error_code(error::timed_out)), "vehicle does not acknowledge data any more");
}

TEST(ErrorText, BeginsWithASmallLetter) {
  const Wording capital("No route to host");
  const Wording small("no route to host");
  const Wording other("\u00c9chec");
  const Wording nothing("");
  EXPECT_EQ(toText(error_code(1, capital)), "no route to host");
  EXPECT_EQ(toText(error_code(1, small)), "no route to host");
  EXPECT_EQ(toText(error_code(1, other)), "\u00c9chec");
  EXPECT_EQ(toText(error_code(1, nothing)), "");
}

}  // namespace
}  // namespace frontseat_driver::link::testing
