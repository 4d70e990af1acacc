// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/vtu_data.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace seam {

namespace {

using Bytes = std::vector<unsigned char>;

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : c == '=' ? 0 : -1;
}

/// Reads bytes from raw text or from base64 segments, never beyond the end.
class Source {
 public:
  Source(std::string_view text, bool base64) : text_(text), base64_(base64) {
    while (base64_ && at_ < text_.size() && base64_digit(text_[at_]) < 0) ++at_;
  }

  /// The next `count` bytes, without moving on.
  [[nodiscard]] Bytes peek(std::size_t count) const {
    if (count > left())
      throw VtuDataError(
          fmt::format("claims {} bytes where the file has {}; it is truncated or broken", count, left()));
    Bytes bytes(count);
    if (!base64_) {
      std::copy_n(text_.begin() + static_cast<std::ptrdiff_t>(at_), count, bytes.begin());
      return bytes;
    }
    for (std::size_t i = 0; i < count; i += 3) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const int digit = base64_digit(text_[at_ + i / 3 * 4 + k]);
        if (digit < 0) throw VtuDataError("has characters that are not base64");
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
      }
      for (std::size_t k = 0; k < 3 && i + k < count; ++k)
        bytes[i + k] = static_cast<unsigned char>(bits >> (16 - 8 * k));
    }
    return bytes;
  }
  /// The next `count` bytes. In base64 they are a segment of their own, padded at its end.
  Bytes take(std::size_t count) {
    Bytes bytes = peek(count);
    at_ += base64_ ? (count + 2) / 3 * 4 : count;
    return bytes;
  }
  [[nodiscard]] std::size_t left() const {
    return base64_ ? (text_.size() - at_) / 4 * 3 : text_.size() - at_;
  }

 private:
  std::string_view text_;
  bool base64_;
  std::size_t at_ = 0;
};

std::size_t number(const Bytes& bytes, std::size_t index, std::size_t size) {
  std::uint64_t value = 0;
  std::memcpy(&value, &bytes[index * size], size);
  return value;
}

void check_size(std::size_t found, std::size_t expected) {
  if (expected != any_size && found != expected)
    throw VtuDataError(fmt::format("has {} bytes; expected {}", found, expected));
}

vtkSmartPointer<vtkDataCompressor> make_compressor(VtuEncoding::Compressor kind) {
  vtkSmartPointer<vtkDataCompressor> compressor;
  if (kind == VtuEncoding::Compressor::zlib)
    compressor = vtkSmartPointer<vtkZLibDataCompressor>::New();
  else
    compressor = vtkSmartPointer<vtkLZ4DataCompressor>::New();
  // Whoever observes errors gets them instead of the terminal; what went wrong shows in the return value.
  vtkNew<vtkCallbackCommand> quiet;
  quiet->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  compressor->AddObserver(vtkCommand::ErrorEvent, quiet);
  return compressor;
}

Bytes decompress(Source source, const VtuEncoding& encoding, std::size_t expected) {
  const std::size_t h = encoding.header_bytes;
  // Zlib's limit is 1032 to 1, that of LZ4 is 255 to 1.
  constexpr std::size_t best_ratio = 1040, slack = 64;
  const std::size_t blocks = number(source.peek(h), 0, h);
  if (blocks > source.left() / h)
    throw VtuDataError(fmt::format("claims {} compressed blocks, more than fit", blocks));
  if (blocks == 0) {
    check_size(0, expected);
    return {};
  }
  const Bytes header = source.take((3 + blocks) * h);
  const std::size_t full = number(header, 1, h), partial = number(header, 2, h);
  std::vector<std::size_t> sizes(blocks);
  std::size_t total = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    sizes[b] = number(header, 3 + b, h);
    if (sizes[b] > source.left() - total)
      throw VtuDataError("claims more compressed bytes than the file has");
    total += sizes[b];
  }
  const Bytes packed = source.take(total);
  const auto compressor = make_compressor(encoding.compressor);
  Bytes result;
  std::size_t at = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t size = b + 1 == blocks && partial != 0 ? partial : full;
    if (size / best_ratio > sizes[b] + slack)
      throw VtuDataError(fmt::format("claims a block of {} bytes", size));
    if (result.size() + size > expected) check_size(result.size() + size, expected);
    const std::size_t from = result.size();
    result.resize(from + size);
    if (size > 0 && compressor->Uncompress(packed.data() + at, sizes[b], result.data() + from, size) != size)
      throw VtuDataError("has a compressed block that cannot be decompressed");
    at += sizes[b];
  }
  check_size(result.size(), expected);
  return result;
}

}  // namespace

std::vector<unsigned char> decode_vtu_data(std::string_view text, bool base64, const VtuEncoding& encoding,
                                           std::size_t expected) {
  Source source(text, base64);
  if (encoding.compressor != VtuEncoding::Compressor::none) return decompress(source, encoding, expected);
  const std::size_t h = encoding.header_bytes;
  const std::size_t size = number(source.peek(h), 0, h);
  check_size(size, expected);
  if (size > source.left() || h > source.left() - size)
    throw VtuDataError(
        fmt::format("claims {} bytes where the file has {}; it is truncated or broken", size, source.left()));
  Bytes bytes = source.take(h + size);  // header and data are one segment
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(h));
  return bytes;
}

}  // namespace seam
