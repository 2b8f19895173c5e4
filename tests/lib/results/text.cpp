#include <arcslip/results/text.hpp>

#include <cmath>

#include "catch.hpp"

using arcslip::results::doubtful_error;
using arcslip::results::visible;
using arcslip::results::visible_lines, arcslip::results::with_error;

TEST_CASE("what commands a terminal, turns the direction of writing or is no character is escaped") {
  CHECK(visible("\x1b]0;owned\a\x1b[31m") == "\\u001b]0;owned\\u0007\\u001b[31m");
  CHECK(visible("\xc2\x9b"
                "31m") == "\\u009b31m");  // CSI of C1
  CHECK(visible("a\nb\r\tc\x7f") == "a\\u000ab\\u000d\\u0009c\\u007f");
  CHECK(visible("\xe2\x80\xae") == "\\u202e");  // right-to-left override
  CHECK(visible("\xe2\x80\xa8") == "\\u2028");  // line separator
  CHECK(visible("\xef\xbf\xbe\xef\xbf\xbf") == "\\ufffe\\uffff");
  CHECK(visible("\xf0\x9f\xbf\xbe") == "\\ud83f\\udffe");  // U+1FFFE
  CHECK(visible(std::string("a\0b", 3)) == "a\\u0000b");
}

TEST_CASE("bytes that are not UTF-8 are escaped one by one") {
  CHECK(visible("\x9b") == "\\x9b");
  CHECK(visible("\xc0\x8a") == "\\xc0\\x8a");  // overlong
  CHECK(visible("\xe0\x80\x9b") == "\\xe0\\x80\\x9b");
  CHECK(visible("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // above U+10FFFF
  CHECK(visible("a\xc3") == "a\\xc3");
  CHECK(visible("\xe2\x82") == "\\xe2\\x82");
}

TEST_CASE("all other text stays, also what was escaped before, and line breaks where they are asked for") {
  const std::string text = "\xc2\xb5 = 0.5, \xe6\x91\xa9\xe6\x93\xa6 \xf0\x9f\x8e\xbb \"q\" \\ ~";
  CHECK(visible(text) == text);
  const std::string once = visible("\x1b\x9b\n");
  CHECK(visible(once) == once);
  CHECK(visible_lines("a\nb\x1b") == "a\nb\\u001b");
}

TEST_CASE("a quantity near the largest number is that number, not infinity") {
  using arcslip::results::quantity;
  CHECK(quantity(1.7976931348623157e308, "N") == "1.7976931348623157e+308 N");
  CHECK(quantity(-1.7976931348623157e308, "-") == "-1.7976931348623157e+308");
  CHECK(quantity(1.23456789012345e300, "N") == "1.23456789e+300 N");
}

TEST_CASE("digits below twice an estimated error are not printed") {
  CHECK(with_error(3.36660710e-3, 0, "%.8e") == "3.36660710e-03");
  CHECK(with_error(3.36660710e-3, std::nan(""), "%.8e") == "3.36660710e-03");
  CHECK(with_error(3.36660710e-3, 4e-8, "%.8e") == "3.3666e-03");
  CHECK(with_error(3.36660710e-3, 6e-8, "%.8e") == "3.367e-03");
  CHECK(with_error(3.36660710e-3, 1e-20, "%.8e") == "3.36660710e-03");
  CHECK(with_error(3.36660710e-3, 1, "%.8e") == "3.4e-03");
  CHECK(with_error(-31.89251693, 4e-4, "%.8f") == "-31.893");
  CHECK(with_error(31.89251693, 100, "%.8f") == "32");
  CHECK(with_error(24.533048, 4e-4, "%.8g") == "24.533");
  CHECK(with_error(24.533048, 60, "%.8g") == "25");
  CHECK(with_error(0.678036, 8.8e-3, "%.8f") == "0.68");
  CHECK(with_error(0, 1e-3, "%.8f") == "0.00000000");
  CHECK(with_error(HUGE_VAL, 1e-3, "%.2f") == "inf");
  // Three of an error that may be too low, but not of one that is not known.
  CHECK(with_error(20.0292721, doubtful_error(20.0292721, std::nan("")), "%.8f") == "20.02927210");
  CHECK(with_error(8.8419106e-4, doubtful_error(8.8419106e-4, 0), "%.8e") == "8.84e-04");
  CHECK(with_error(-9.9, doubtful_error(-9.9, 1e-9), "%.8f") == "-9.90");
  CHECK(with_error(20.0292721, doubtful_error(20.0292721, 0.3), "%.8f") == "20");
}

TEST_CASE("quantities for people have a prefix with which they lie from 0.1 to 100") {
  using arcslip::results::readable;
  CHECK(readable(6.9434e-4, "m") == "0.6943 mm");
  CHECK(readable(0.0834, "m") == "83.4 mm");
  CHECK(readable(0.1, "m") == "0.1 m");
  CHECK(readable(99.9, "N") == "99.9 N");
  CHECK(readable(100, "N") == "0.1 kN");
  CHECK(readable(3.2e6, "N/m") == "3.2 MN/m");
  CHECK(readable(-5e-5, "m") == "-50 \u00b5m");
  CHECK(readable(1e-12, "J") == "0.001 nJ");
  CHECK(readable(1e15, "Pa") == "1e+06 GPa");
  CHECK(readable(0, "m") == "0 m");
  CHECK(readable(HUGE_VAL, "m") == "inf m");
  // No prefix would be of the power or of another unit.
  CHECK(readable(1e-4, "m^2") == "0.0001 m^2");
  CHECK(readable(1e4, "N s/m") == "10 kN s/m");
  CHECK(readable(48391.23, "Hz", 6) == "48391.2 Hz");
  CHECK(readable(0.002, "kg") == "0.002 kg");
  CHECK(readable(0.002, "-") == "0.002");
  CHECK(readable(0.002, "") == "0.002");
}
