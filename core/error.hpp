#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace raywatch {

/// What is wrong with one named part of an input: a query value, a JSON member, a header line.
struct FieldError {
  std::string field;
  std::string message;
};

/// Base of everything that this program throws on purpose: the operation cannot go on. The message says what is wrong,
/// where, and what would be right; it is written for the person who gave the input.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is understood but not acceptable: a missing pose, a value out of range, a broken file.
class InvalidInput : public Error {
 public:
  explicit InvalidInput(const std::string& message, std::vector<FieldError> fields = {})
      : Error(message), fields_(std::move(fields)) {}
  const std::vector<FieldError>& fields() const { return fields_; }

 private:
  std::vector<FieldError> fields_;
};

/// The bytes are in no format that this program reads.
class UnsupportedFormat : public Error {
 public:
  using Error::Error;
};

/// The input is larger than the configured limit.
class TooLarge : public Error {
 public:
  using Error::Error;
};

/// What was asked for does not exist.
class NotFound : public Error {
 public:
  using Error::Error;
};

/// The request contradicts what is stored: the same key with other content, a deletion of what is in use.
class Conflict : public Error {
 public:
  explicit Conflict(const std::string& message, std::vector<FieldError> fields = {})
      : Error(message), fields_(std::move(fields)) {}
  const std::vector<FieldError>& fields() const { return fields_; }

 private:
  std::vector<FieldError> fields_;
};

/// The caller's version of what it edits is not the stored one.
class PreconditionFailed : public Error {
 public:
  using Error::Error;
};

/// There is no room for more work now; the same request may succeed after `retry_after`.
class Overloaded : public Error {
 public:
  Overloaded(const std::string& message, std::chrono::seconds retry_after)
      : Error(message), retry_after_(retry_after) {}
  std::chrono::seconds retry_after() const { return retry_after_; }

 private:
  std::chrono::seconds retry_after_;
};

/// The store cannot be read or written: an I/O error, a lock held by another process, a schema that is too new.
class StorageError : public Error {
 public:
  using Error::Error;
};

/// The disk has no room for what must be written. Nothing of the operation was kept.
class DiskFull : public StorageError {
 public:
  using StorageError::StorageError;
};

/// Stored bytes do not match their checksum or contradict themselves.
class CorruptData : public StorageError {
 public:
  using StorageError::StorageError;
};

}  // namespace raywatch
