// SPDX-License-Identifier: BSD-3-Clause
// Images in and out, by OpenCV (image_file.cc alone knows it). Every failure is an InputError of one line
// that names the file: missing, not an image, of a depth that is not read, not to be written.
#pragma once

#include <filesystem>

#include "models/raster.h"

namespace frond {

// The grey levels of any image that OpenCV reads (PNG, JPEG, BMP, TIFF, PGM, …): 8 bits as they are, 16 bits
// times 255/65535 and 32-bit floats as they are; colour by Rec. 601 (0.299 R + 0.587 G + 0.114 B, not rounded
// to whole levels). The orientation that a JPEG's EXIF asks for is not applied: the pixels stay where the
// lens drew them, or a calibration would not fit them.
Image ReadImage(const std::filesystem::path& path);

// Red, green and blue; a grey image has all three alike. 16 bits are rounded to 8.
ColourImage ReadColourImage(const std::filesystem::path& path);

// 1 where the image is at least half as bright as its brightest pixel, so that 0 and 1 will do as well as 0
// and 255. All 0 where it is black.
Mask ReadMask(const std::filesystem::path& path);

// The first channel's values as the file holds them, whatever its depth: levels of a disparity image, floats
// of a TIFF.
Image ReadRawImage(const std::filesystem::path& path);

// The grey levels of a colour image, as ReadImage makes them.
Image GreyImage(const ColourImage& image);

// An 8-bit PNG: grey levels rounded, and held within 0 to 255; a mask's 1 is white.
void WriteImage(const std::filesystem::path& path, const Image& image);
void WriteColourImage(const std::filesystem::path& path, const ColourImage& image);
void WriteMask(const std::filesystem::path& path, const Mask& mask);

// A TIFF of 32-bit floats, NaN included; lossless.
void WriteFloatTiff(const std::filesystem::path& path, const Image& image);

}  // namespace frond
