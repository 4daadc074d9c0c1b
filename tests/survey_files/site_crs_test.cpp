#include "storage/site_crs.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"

namespace raywatch {
namespace {

std::string reason(int epsg) {
  try {
    require_metric(describe_crs(epsg));
  } catch (const InvalidInput& error) {
    REQUIRE(error.fields().size() == 1);
    CHECK(error.fields()[0].field == "epsg");
    return error.fields()[0].message;
  }
  return "";
}

bool says(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST_CASE("PROJ knows what an EPSG code stands for") {
  const CrsInfo utm = describe_crs(25833);
  CHECK(utm.name == "ETRS89 / UTM zone 33N");
  CHECK(utm.unit == "metre");
  CHECK(utm.metres_a_unit == 1.0);
  CHECK(utm.projected);
  CHECK(says(utm.wkt, "PROJCS[\"ETRS89 / UTM zone 33N\""));
  CHECK(reason(25833).empty());
  CHECK(reason(7405).empty());  // a compound one: British National Grid with heights
}

TEST_CASE("what volumes cannot be measured in is refused with the reason") {
  CHECK(says(reason(4326), "is not projected (its unit is the degree)"));
  CHECK(says(reason(2263), "US survey foot"));    // New York
  CHECK(says(reason(4978), "is not projected"));  // geocentric
  CHECK(says(reason(999999), "no code that PROJ knows"));
  CHECK(says(reason(-3), "no code that PROJ knows"));
}

TEST_CASE("places lead to longitude and latitude") {
  // The central meridian of zone 33 is 15 degrees east; 5,540,000 m is a little north of 50 degrees.
  const Eigen::Vector2d degrees = ToWgs84(25833).longitude_latitude_deg({500000.0, 5540000.0});
  CHECK(degrees.x() == doctest::Approx(15.0));
  CHECK(degrees.y() == doctest::Approx(50.0102).epsilon(1e-4));
  CHECK_THROWS_AS(ToWgs84(25833).longitude_latitude_deg({1e12, 1e12}), InvalidInput);
  CHECK_THROWS_AS(ToWgs84(999999), InvalidInput);
}

}  // namespace
}  // namespace raywatch
