// Euclidean clustering, with PCL's as the oracle.

#include "core/cluster.hpp"

#include <doctest/doctest.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <rapidcheck.h>
#include <pcl/segmentation/impl/extract_clusters.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <random>

namespace raywatch {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// The clusters as sets of point numbers, in a canonical order.
std::vector<std::vector<int>> as_sets(const std::vector<std::uint32_t>& clusters) {
  std::map<std::uint32_t, std::vector<int>> members;
  for (std::size_t i = 0; i < clusters.size(); ++i) members[clusters[i]].push_back(static_cast<int>(i));
  std::vector<std::vector<int>> sets;
  for (auto& [number, set] : members) sets.push_back(std::move(set));
  std::sort(sets.begin(), sets.end());
  return sets;
}

std::vector<std::vector<int>> pcl_clusters(const Points& points, double distance_m) {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const auto& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(distance_m);
  extraction.setMinClusterSize(1);
  extraction.setMaxClusterSize(std::numeric_limits<int>::max());
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(cloud);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  std::vector<std::vector<int>> sets;
  for (auto& cluster : found) {
    std::sort(cluster.indices.begin(), cluster.indices.end());
    sets.emplace_back(cluster.indices.begin(), cluster.indices.end());
  }
  std::sort(sets.begin(), sets.end());
  return sets;
}

Points random_points(std::uint32_t seed, std::size_t n, double extent_m) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  Points points;
  Eigen::Vector3f blob = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 20 == 0) blob = Eigen::Vector3f(unit(random), unit(random), unit(random)) * static_cast<float>(extent_m);
    points.push_back(blob + 0.15f * Eigen::Vector3f(unit(random), unit(random), unit(random)));
  }
  return points;
}

TEST_CASE("clusters are those of PCL's Euclidean clustering") {
  CHECK(rc::check([] {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const auto n = *rc::gen::inRange<std::size_t>(1, 600);
    const double extent_m = *rc::gen::element(0.2, 1.0, 3.0);
    const Points points = random_points(seed, n, extent_m);
    RC_ASSERT(as_sets(cluster_points(points, 0.1)) == pcl_clusters(points, 0.1));
  }));
}

TEST_CASE("no points give no clusters, one point gives one") {
  CHECK(cluster_points({}, 0.1).empty());
  CHECK(cluster_points(Points{{1, 2, 3}}, 0.1) == std::vector<std::uint32_t>{0});
}

TEST_CASE("a chain of points nearer than the distance is one cluster however long it is") {
  Points chain;
  for (int i = 0; i < 500; ++i) chain.emplace_back(0.09f * static_cast<float>(i), 0.0f, 0.0f);
  const auto clusters = cluster_points(chain, 0.1);
  CHECK(*std::max_element(clusters.begin(), clusters.end()) == 0);
}

TEST_CASE("points at the distance itself do not belong together") {
  CHECK(cluster_points(Points{{0, 0, 0}, {0.125f, 0, 0}}, 0.125) == std::vector<std::uint32_t>{0, 1});
  CHECK(cluster_points(Points{{0, 0, 0}, {0.125f, 0, 0}}, 0.1251) == std::vector<std::uint32_t>{0, 0});
}

TEST_CASE(
    "very many points in one place, and as many just beyond the distance, are clustered without pairing them all") {
  Points points;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 0.04f);
  for (int i = 0; i < 200'000; ++i) points.emplace_back(unit(random), unit(random), unit(random));
  for (int i = 0; i < 200'000; ++i) points.emplace_back(0.1401f + unit(random), unit(random), unit(random));
  const auto clusters = cluster_points(points, 0.1);
  CHECK(clusters.front() == 0);
  CHECK(clusters.back() == 1);
}

TEST_CASE("the numbering follows the first point of each cluster") {
  CHECK(cluster_points(Points{{5, 0, 0}, {0, 0, 0}, {5.05f, 0, 0}, {9, 0, 0}}, 0.1) ==
        std::vector<std::uint32_t>{0, 1, 0, 2});
}

TEST_CASE("with a reach for every point, two belong together when nearer than the smaller of their reaches") {
  const Points points{{0, 0, 0}, {0.15f, 0, 0}, {10, 0, 0}, {10.35f, 0, 0}, {10.5f, 0, 0}};
  CHECK(cluster_points(points, std::vector<float>{0.1f, 0.5f, 0.5f, 0.5f, 0.1f}) ==
        std::vector<std::uint32_t>{0, 1, 2, 2, 3});
}

TEST_CASE("equal reaches are one distance") {
  const Points points = random_points(7, 300, 1.0);
  CHECK(cluster_points(points, std::vector<float>(points.size(), 0.1f)) == cluster_points(points, 0.1f));
}

}  // namespace
}  // namespace raywatch
