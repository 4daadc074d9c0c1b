#include "storage/writer_thread.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace raywatch {
namespace {

TEST_CASE("all work of a writer runs on one thread that is not the caller's") {
  WriterThread writer;
  std::thread::id first, second;
  writer.run([&] { first = std::this_thread::get_id(); });
  writer.run([&] { second = std::this_thread::get_id(); });
  CHECK(first == second);
  CHECK(first != std::this_thread::get_id());
}

TEST_CASE("what work throws comes out at its caller, and the writer goes on") {
  WriterThread writer;
  CHECK_THROWS_AS(writer.run([] { throw std::out_of_range("no"); }), std::out_of_range);
  bool ran = false;
  writer.run([&] { ran = true; });
  CHECK(ran);
}

TEST_CASE("work of many callers never overlaps") {
  WriterThread writer;
  int counter = 0;
  {
    std::vector<std::jthread> callers;
    for (int i = 0; i < 4; ++i) {
      callers.emplace_back([&] {
        for (int j = 0; j < 500; ++j) writer.run([&] { ++counter; });
      });
    }
  }
  CHECK(counter == 2000);
}

TEST_CASE("work that hands over work is refused instead of waiting for itself") {
  WriterThread writer;
  CHECK_THROWS_AS(writer.run([&] { writer.run([] {}); }), std::logic_error);
}

}  // namespace
}  // namespace raywatch
