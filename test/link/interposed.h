#pragma once

/// Calls of the C library that the tests answer themselves, so that none asks a name server:
///   hanging.test   hangs until releaseHangingNames(), then is 127.0.0.1
///   second.test    is 127.0.0.2, then 127.0.0.1
///   absent.test    does not exist
///   broken.test    cannot be looked up now
/// Other names go to the system.
namespace frontseat_driver::link::testing {

void hangNames();

/// Lets look-ups that hang go on, and further ones too.
void releaseHangingNames();

/// From now on a connecting socket gets the port it connects to as its own, as may happen by
/// chance.
void connectToItself(bool on);

}  // namespace frontseat_driver::link::testing
