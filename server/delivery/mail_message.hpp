#pragma once

#include <string>

#include "server/delivery/sender.hpp"

namespace raywatch {

/// A message as a mail (RFC 5322, lines end in CRLF): a subject and a plain text that a guard understands. Whatever the
/// names in it are, they cannot add a header: control characters become blanks, and what is no ASCII is encoded.
std::string mail_message(const MailSettings& settings, const Message& message);

/// The value of a header with any text (RFC 2047), folded.
std::string encoded_header(std::string text);

}  // namespace raywatch
