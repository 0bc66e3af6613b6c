#pragma once

/// Calls of the C library that the tests answer themselves, so that none asks a name server:
///   hanging.test   hangs until releaseHangingNames(), then is 127.0.0.1
///   second.test    is 127.0.0.2, then 127.0.0.1
///   absent.test    does not exist
///   broken.test    cannot be looked up now
///   files.test     cannot be looked up since the system is out of file descriptors
///   alien.test     is an address of a kind that TCP does not have
///   mixed.test     is such an address, then 127.0.0.1
/// Other names go to the system.
namespace frontseat_driver::link::testing {

void hangNames();

/// Lets look-ups that hang go on, and further ones too.
void releaseHangingNames();

/// From now on a connecting socket gets the port it connects to as its own, as may happen by
/// chance.
void connectToItself(bool on);

/// From now on the kernel gives every connection up at once with this error; 0 ends that.
void failConnects(int error);

/// From now on no socket can be opened, for this reason; 0 ends that.
void failSockets(int error);

}  // namespace frontseat_driver::link::testing
