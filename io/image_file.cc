// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "io/file_bytes.h"

namespace frond {
namespace {

constexpr float kWhite = 255;
constexpr float kSixteenBits = kWhite / 65535;
constexpr float kRed = 0.299f, kGreen = 0.587f, kBlue = 0.114f;  // Rec. 601

// Whether a JPEG or PNG lacks its end mark. libjpeg would fill up what is lost with grey, and libpng complain
// on stderr. Bytes after the mark (previews that some cameras append) do no harm.
bool IsCut(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xD8")) return bytes.find("\xFF\xD9") == std::string_view::npos;
  return bytes.starts_with("\x89PNG") && bytes.find("IEND") == std::string_view::npos;
}

// As it is in the file: any depth, blue, green, red and perhaps alpha where there is colour.
cv::Mat Decode(const std::filesystem::path& path) {
  const std::string bytes = ReadFileBytes(path);
  if (bytes.empty()) FailFile(path, "is empty");
  if (IsCut(bytes)) FailFile(path, "is truncated (it has no end mark); copy it again");
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::Mat pixels;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    pixels = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);  // EXIF's orientation unheeded
  } catch (const cv::Exception& error) {
    FailFile(path, "cannot be read as an image: " + std::string(error.err));
  }
  if (pixels.empty()) FailFile(path, "is not an image, or is damaged (png, jpg, bmp, tiff, pgm … are read)");
  const int depth = pixels.depth();
  if (depth != CV_8U && depth != CV_16U && depth != CV_32F) {
    FailFile(path, "its pixels are neither 8 nor 16 bits nor 32-bit floats; convert it to one of them");
  }
  return pixels;
}

// One value of a pixel, as the file has it.
float Value(const cv::Mat& pixels, int x, int y, int channel) {
  const int index = x * pixels.channels() + channel;
  if (pixels.depth() == CV_8U) return pixels.ptr<std::uint8_t>(y)[index];
  if (pixels.depth() == CV_16U) return pixels.ptr<std::uint16_t>(y)[index];
  return pixels.ptr<float>(y)[index];
}

float Scale(const cv::Mat& pixels) { return pixels.depth() == CV_16U ? kSixteenBits : 1; }

// NaN becomes black.
std::uint8_t Rounded(float level) {
  return static_cast<std::uint8_t>(level > 0 ? std::lround(std::min(level, kWhite)) : 0);
}

// value(x, y) of every pixel.
template <typename RasterType, typename Function>
RasterType Filled(int width, int height, const Function& value) {
  RasterType raster(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) raster(x, y) = value(x, y);
  }
  return raster;
}

void Encode(const std::filesystem::path& path, const char* extension, const cv::Mat& pixels) {
  if (pixels.empty()) FailFile(path, "an image without pixels is not written");
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(extension, pixels, bytes)) FailFile(path, "cannot be encoded");
  WriteFileBytes(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

Image ReadImage(const std::filesystem::path& path) {
  const cv::Mat pixels = Decode(path);
  const float scale = Scale(pixels);
  return Filled<Image>(pixels.cols, pixels.rows, [&](int x, int y) {
    const float first = Value(pixels, x, y, 0);
    if (pixels.channels() < 3) return scale * first;
    return scale * (kBlue * first + kGreen * Value(pixels, x, y, 1) + kRed * Value(pixels, x, y, 2));
  });
}

ColourImage ReadColourImage(const std::filesystem::path& path) {
  const cv::Mat pixels = Decode(path);
  const float scale = Scale(pixels);
  return Filled<ColourImage>(pixels.cols, pixels.rows, [&](int x, int y) {
    std::array<std::uint8_t, 3> colour{};
    for (int channel = 0; channel < 3; ++channel) {
      const int of_file = pixels.channels() < 3 ? 0 : 2 - channel;
      colour[static_cast<std::size_t>(channel)] = Rounded(scale * Value(pixels, x, y, of_file));
    }
    return colour;
  });
}

Mask ReadMask(const std::filesystem::path& path) {
  const Image image = ReadImage(path);
  const float brightest = *std::max_element(image.values.begin(), image.values.end());
  return Filled<Mask>(image.width, image.height, [&](int x, int y) {
    return static_cast<std::uint8_t>(brightest > 0 && image(x, y) >= brightest / 2);
  });
}

Image ReadRawImage(const std::filesystem::path& path) {
  const cv::Mat pixels = Decode(path);
  const int channel = pixels.channels() < 3 ? 0 : 2;
  return Filled<Image>(pixels.cols, pixels.rows, [&](int x, int y) { return Value(pixels, x, y, channel); });
}

Image GreyImage(const ColourImage& image) {
  return Filled<Image>(image.width, image.height, [&](int x, int y) {
    const auto& [red, green, blue] = image(x, y);
    return kBlue * static_cast<float>(blue) + kGreen * static_cast<float>(green) +
           kRed * static_cast<float>(red);
  });
}

void WriteImage(const std::filesystem::path& path, const Image& image) {
  cv::Mat pixels(image.height, image.width, CV_8U);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) pixels.at<std::uint8_t>(y, x) = Rounded(image(x, y));
  }
  Encode(path, ".png", pixels);
}

void WriteColourImage(const std::filesystem::path& path, const ColourImage& image) {
  cv::Mat pixels(image.height, image.width, CV_8UC3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto& [red, green, blue] = image(x, y);
      pixels.at<cv::Vec3b>(y, x) = cv::Vec3b(blue, green, red);
    }
  }
  Encode(path, ".png", pixels);
}

void WriteMask(const std::filesystem::path& path, const Mask& mask) {
  WriteImage(path, Filled<Image>(mask.width, mask.height,
                                 [&](int x, int y) { return mask(x, y) != 0 ? kWhite : 0.0f; }));
}

void WriteFloatTiff(const std::filesystem::path& path, const Image& image) {
  cv::Mat pixels(image.height, image.width, CV_32F);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) pixels.at<float>(y, x) = image(x, y);
  }
  Encode(path, ".tiff", pixels);
}

}  // namespace frond
