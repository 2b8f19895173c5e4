#pragma once
// MATLAB files of version 5, byte by byte.

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace mat_bytes {

/// The bytes of numbers as this machine has them, which the "IM" of the header says is little-endian.
template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  std::string text(numbers.size() * sizeof(T), '\0');
  if (!text.empty()) std::memcpy(text.data(), numbers.data(), text.size());
  return text;
}

inline std::string header(std::string_view says = "MATLAB 5.0 MAT-file", char version = 1) {
  std::string text(says);
  text.resize(116, ' ');
  return text + std::string(8, '\0') + std::string{'\0', version} + "IM";
}

/// reported: the length that it says it has.
inline std::string element(std::uint32_t type, const std::string& data, std::uint32_t reported) {
  const std::string padding((8 - data.size() % 8) % 8, '\0');
  return bytes_of<std::uint32_t>({type, reported}) + data + padding;
}
inline std::string element(std::uint32_t type, const std::string& data) {
  return element(type, data, static_cast<std::uint32_t>(data.size()));
}

/// Of what both kinds of matrices begin with. kind: 5 sparse, 6 full.
inline std::string description(std::uint32_t kind, std::uint32_t most_entries, std::int32_t rows,
                               std::int32_t columns, const std::string& name) {
  return element(6, bytes_of<std::uint32_t>({kind, most_entries})) +
         element(5, bytes_of<std::int32_t>({rows, columns})) + element(1, name);
}

inline std::string full(const std::string& name, std::int32_t rows, std::int32_t columns,
                        const std::vector<double>& values) {
  return element(14, description(6, 0, rows, columns, name) + element(9, bytes_of(values)));
}

/// The same element, "compressed" by zlib's format without making it shorter.
inline std::string packed(const std::string& whole) {
  std::uint32_t a = 1, b = 0;
  for (const char c : whole) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto low = static_cast<std::uint16_t>(whole.size());
  std::string data =
      "\x78\x01\x01" + bytes_of<std::uint16_t>({low, static_cast<std::uint16_t>(~low)}) + whole;
  for (const std::uint32_t sum : {b, a}) {
    data += static_cast<char>(sum >> 8);
    data += static_cast<char>(sum & 0xff);
  }
  return bytes_of<std::uint32_t>({15, static_cast<std::uint32_t>(data.size())}) + data;
}

}  // namespace mat_bytes
