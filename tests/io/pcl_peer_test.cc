// SPDX-License-Identifier: BSD-3-Clause
// PLY and PCD against PCL: it reads what we write, we read what it writes. The only test with PCL's headers.
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/errors.h"
#include "base/random.h"
#include "io/point_cloud_file.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

pcl::PointCloud<pcl::PointXYZRGBNormal> PclCloud() {
  Random random(4);
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  for (int k = 0; k < 1000; ++k) {
    pcl::PointXYZRGBNormal point;
    point.x = static_cast<float>(random.Normal());
    point.y = static_cast<float>(random.Normal());
    point.z = k % 3 == 0 ? 0.0f : static_cast<float>(random.Normal());
    point.r = 3;
    point.normal_z = 1;
    cloud.push_back(point);
  }
  return cloud;
}

TEST(PcdFile, EveryEncodingThatPclWrites_ReadsTheSamePoints) {
  const TempFolder folder;
  const auto cloud = PclCloud();
  const std::string path = (folder / "a.pcd").string();
  for (const int encoding : {0, 1, 2}) {
    const int failed = encoding == 0   ? pcl::io::savePCDFileASCII(path, cloud)
                       : encoding == 1 ? pcl::io::savePCDFileBinary(path, cloud)
                                       : pcl::io::savePCDFileBinaryCompressed(path, cloud);
    ASSERT_EQ(failed, 0);
    const PointCloud read = ReadPointCloud(path);
    ASSERT_EQ(read.points.size(), cloud.size());
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      const double tolerance = encoding == 0 ? 1e-6 : 0;  // PCL's text has 8 digits
      EXPECT_NEAR(read.points[k].x(), static_cast<double>(cloud[k].x), tolerance);
      EXPECT_NEAR(read.points[k].y(), static_cast<double>(cloud[k].y), tolerance);
      EXPECT_NEAR(read.points[k].z(), static_cast<double>(cloud[k].z), tolerance);
    }
  }
}

TEST(PcdFile, NanPointsOfPcl_AreDroppedAndCounted) {
  const TempFolder folder;
  auto cloud = PclCloud();
  for (std::size_t k = 0; k < 10; ++k) cloud[k].x = std::numeric_limits<float>::quiet_NaN();
  const std::string path = (folder / "a.pcd").string();
  for (const bool text : {false, true}) {
    text ? pcl::io::savePCDFileASCII(path, cloud) : pcl::io::savePCDFileBinaryCompressed(path, cloud);
    CloudReport report;
    EXPECT_EQ(ReadPointCloud(path, &report).points.size(), 990u);
    EXPECT_EQ(report.dropped_not_finite, 10u);
  }
}

TEST(PcdFile, BadFiles_AreRefusedInOneLine) {
  const TempFolder folder;
  const std::string path = (folder / "a.pcd").string();
  const auto error = [&](const std::string& bytes) {
    folder.Write("a.pcd", bytes);
    return MessageOf<InputError>([&] { ReadPointCloud(path); });
  };
  const std::string start = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  EXPECT_TRUE(Holds(error("hello\n"), "is not a PCD file"));
  EXPECT_TRUE(Holds(error(start + "POINTS 2\n"), "no DATA line"));
  EXPECT_TRUE(
      Holds(error(start + "POINTS 2\nDATA binary\nabcdefghijklmnop"), "promises 2 points, 1 are there"));
  EXPECT_TRUE(Holds(error(start + "POINTS 4000000000000\nDATA binary\nabc"),
                    "promises 4000000000000 points, 0 are there"));
  EXPECT_TRUE(
      Holds(error(start + "WIDTH 4000000000000\nHEIGHT 4000000000000\nDATA binary\nabc"), "is truncated"));
  EXPECT_TRUE(
      Holds(error(start + "POINTS 2\nDATA ascii\n1 2 3\n1 b 3\n"), "line 8: value 2 is not a number"));
  EXPECT_TRUE(Holds(error(start + "POINTS 2\nDATA sideways\n"), "DATA is not ascii"));
  EXPECT_TRUE(Holds(error("FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nPOINTS 1\nDATA ascii\n1 2\n"),
                    "has no field 'z'"));
  const auto cloud = PclCloud();
  pcl::io::savePCDFileBinaryCompressed(path, cloud);
  const std::string whole = FileText(path);
  EXPECT_TRUE(Holds(error(whole.substr(0, whole.size() - 100)), "is truncated or damaged"));
  Random random(9);
  for (int trial = 0; trial < 200; ++trial) {
    std::string damaged = whole;
    for (int k = 0; k < 20; ++k)
      damaged[300 + random.Below(damaged.size() - 300)] = static_cast<char>(random.Below(256));
    folder.Write("a.pcd", damaged);
    try {
      ReadPointCloud(path);
    } catch (const InputError&) {
    }
  }
}

TEST(PlyFile, PclReadsWhatWeWrite) {
  const TempFolder folder;
  Random random(6);
  PointCloud cloud;
  CloudAttributes attributes;
  for (int k = 0; k < 100; ++k) {
    cloud.points.emplace_back(random.Normal(), random.Normal(), random.Normal());
    attributes.deviation.push_back(random.Normal());
    attributes.colours.push_back({10, 20, 30});
    attributes.normals.push_back(Eigen::Vector3d(random.Normal(), random.Normal(), 1).normalized());
    attributes.standard_deviation.push_back(0.01 * k);
  }
  WritePointCloud(folder / "a.ply", cloud, attributes);
  pcl::PCLPointCloud2 read;
  pcl::PLYReader reader;
  ASSERT_EQ(reader.read((folder / "a.ply").string(), read), 0);
  ASSERT_EQ(read.width * read.height, 100u);
  for (const pcl::PCLPointField& field : read.fields) {
    const std::size_t axis = field.name == "x" ? 0 : field.name == "y" ? 1 : field.name == "z" ? 2 : 3;
    if (axis == 3) continue;
    ASSERT_EQ(field.datatype, pcl::PCLPointField::FLOAT64);
    for (std::size_t k = 0; k < 100; ++k) {
      double value = 0;
      std::memcpy(&value, read.data.data() + k * read.point_step + field.offset, sizeof(value));
      EXPECT_EQ(value, cloud.points[k][static_cast<Eigen::Index>(axis)]);
    }
  }
  // What PCL makes points of: normals and colours.
  pcl::PointCloud<pcl::PointNormal> normals;
  pcl::PointCloud<pcl::RGB> colours;
  pcl::fromPCLPointCloud2(read, normals);
  pcl::fromPCLPointCloud2(read, colours);
  const auto sigma = std::find_if(read.fields.begin(), read.fields.end(),
                                  [](const auto& field) { return field.name == "standard_deviation"; });
  ASSERT_NE(sigma, read.fields.end());
  ASSERT_EQ(sigma->datatype, pcl::PCLPointField::FLOAT32);
  for (std::size_t k = 0; k < 100; ++k) {
    EXPECT_EQ(normals[k].normal_x, static_cast<float>(attributes.normals[k].x()));
    EXPECT_EQ(normals[k].normal_z, static_cast<float>(attributes.normals[k].z()));
    EXPECT_EQ(colours[k].r, 10);
    EXPECT_EQ(colours[k].b, 30);
    float value = 0;
    std::memcpy(&value, read.data.data() + k * read.point_step + sigma->offset, sizeof(value));
    EXPECT_EQ(value, static_cast<float>(attributes.standard_deviation[k]));
  }
  EXPECT_EQ(ReadPointCloud(folder / "a.ply").points, cloud.points);
}

TEST(PlyFile, WeReadWhatPclWrites) {
  const TempFolder folder;
  const auto cloud = PclCloud();
  for (const bool binary : {true, false}) {
    const std::string path = (folder / "a.ply").string();
    ASSERT_EQ(pcl::io::savePLYFile(path, cloud, binary), 0);
    const PointCloud read = ReadPointCloud(path);
    ASSERT_EQ(read.points.size(), cloud.size());
    EXPECT_NEAR(read.points[7].y(), static_cast<double>(cloud[7].y), binary ? 0 : 1e-5);
  }
}

}  // namespace
}  // namespace frond
