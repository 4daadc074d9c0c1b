#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "api/openapi_text.hpp"
#include "api/routes.hpp"
#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

const std::set<std::string> kMethods = {"get", "post", "put", "patch", "delete"};

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::set<std::string> registered() {
  std::set<std::string> list;
  for (const Route& route : routes()) list.insert(std::string(route.method) + " " + std::string(route.pattern));
  return list;
}

std::set<std::string> described() {
  std::set<std::string> list;
  for (const auto& [path, operations] : contract().document()["paths"].items())
    for (const auto& [method, operation] : operations.items())
      if (kMethods.contains(method)) list.insert(upper_case(method) + " " + path);
  return list;
}

/// Calls `visit` with every value of a member `name`, at any depth.
template <class Visit>
void each_member(const json& value, const std::string& name, const Visit& visit) {
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      if (key == name) visit(member);
      each_member(member, name, visit);
    }
  } else if (value.is_array()) {
    for (const json& element : value) each_member(element, name, visit);
  }
}

TEST_CASE("every registered route stands in the contract, and every path there is registered") {
  CHECK_EQ(registered(), described());
}

TEST_CASE("the summaries of the routes are those of the contract") {
  for (const Route& route : routes()) {
    std::string method(route.method);
    for (char& c : method) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    CHECK_EQ(contract().document()["paths"][std::string(route.pattern)][method]["summary"], route.summary);
  }
}

TEST_CASE("every schema of the contract uses only keywords that the tests check, and every reference leads somewhere") {
  for (const auto& [name, schema] : contract().document()["components"]["schemas"].items()) {
    CAPTURE(name);
    CHECK(contract().schemas().unknown_keywords(schema).empty());
  }
  each_member(contract().document(), "$ref", [](const json& reference) {
    CAPTURE(reference);
    CHECK(contract().document().contains(json::json_pointer(reference.get<std::string>().substr(1))));
  });
}

TEST_CASE("every example of the contract fits its own schema") {
  each_member(contract().document(), "content", [](const json& content) {
    for (const auto& [type, media] : content.items()) {
      if (!media.contains("example")) continue;
      const auto complaints = contract().schemas().check(media["example"], media["schema"]);
      CAPTURE(media["example"]);
      CHECK_MESSAGE(complaints.empty(), (complaints.empty() ? "" : complaints.front()));
    }
  });
}

TEST_CASE("the placeholders of a path are its path parameters") {
  for (const auto& [path, operations] : contract().document()["paths"].items()) {
    std::set<std::string> named;
    for (const json& parameter : operations.value("parameters", json::array())) {
      const json& resolved = contract().resolved(parameter);
      if (resolved["in"] == "path") named.insert(resolved["name"]);
    }
    const auto open = path.find('{');
    const std::set<std::string> placed = open == std::string::npos
                                             ? std::set<std::string>{}
                                             : std::set<std::string>{path.substr(open + 1, path.find('}') - open - 1)};
    CHECK_EQ(named, placed);
  }
}

TEST_CASE("every query parameter of the contract is known to the program, and each other one is refused by name") {
  ApiFixture api;
  api.make_site_and_sensor();
  const auto id = std::to_string(api.upload(0)["id"].get<int>());
  for (const auto& [path, operations] : contract().document()["paths"].items()) {
    if (!operations.contains("get")) continue;
    std::string target = path;
    if (const auto at = target.find("{id}"); at != std::string::npos) target.replace(at, 4, id);
    if (const auto at = target.find("{name}"); at != std::string::npos) {
      target.replace(at, 6, path.find("sites") != std::string::npos ? "yard" : "gate");
    }
    CAPTURE(path);
    const Reply refused = api.get(target + "?nonsense=1");
    REQUIRE_EQ(refused.status, 422);
    CHECK_NE(refused.complaint_about("nonsense"), "");
    for (const json& parameter : operations["get"].value("parameters", json::array())) {
      const json& resolved = contract().resolved(parameter);
      if (resolved["in"] != "query") continue;
      const std::string name = resolved["name"];
      const Reply reply = api.get(target + "?" + name + "=");
      CHECK_EQ(reply.complaint_about(name), "is empty");
    }
  }
}

TEST_CASE("the contract is served as it stands in the file, with a tag") {
  ApiFixture api;
  const Reply reply = api.get("/openapi.json");
  CHECK_EQ(reply.body, openapi_text());
  CHECK_EQ(api.get("/openapi.json", {{"If-None-Match", reply.header("ETag")}}).status, 304);
  CHECK_EQ(api.get("/openapi.json", {{"If-None-Match", "\"other\""}}).status, 200);
}

}  // namespace
}  // namespace raywatch::testing
