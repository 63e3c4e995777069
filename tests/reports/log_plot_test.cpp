// SVG plots: well formed, one marker per point, where it belongs.
#include "reports/log_plot.h"

#include <doctest/doctest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace moire;

namespace {

// Whether a text is an XML document: tags nested and closed, attributes quoted and not repeated, no bare & or <. Enough
// of XML 1.0 for files without comments and CDATA.
class XmlReader {
 public:
  explicit XmlReader(const std::string& text) : text_(text) {}

  bool is_well_formed() {
    if (text_.starts_with("<?xml")) at_ = text_.find("?>") + 2;
    skip_blanks();
    if (!element()) return false;
    skip_blanks();
    return at_ == text_.size();
  }

 private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(const std::string& word) {
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }
  void skip_blanks() {
    while (std::isspace(static_cast<unsigned char>(here())) != 0) ++at_;
  }
  std::string name() {
    const std::size_t begin = at_;
    while (std::isalnum(static_cast<unsigned char>(here())) != 0 || here() == '-' || here() == ':') ++at_;
    return text_.substr(begin, at_ - begin);
  }
  // Characters up to `end`, entities whole.
  bool characters(char end) {
    while (here() != end) {
      if (here() == '\0' || here() == '<' || static_cast<unsigned char>(here()) < 9) return false;
      if (here() == '&' && !take("&amp;") && !take("&lt;") && !take("&gt;") && !take("&quot;")) return false;
      if (here() != end && here() != '&') ++at_;
    }
    return true;
  }
  bool element() {
    if (!take("<")) return false;
    const std::string tag = name();
    std::vector<std::string> attributes;
    for (skip_blanks(); here() != '>' && here() != '/'; skip_blanks()) {
      attributes.push_back(name());
      for (std::size_t i = 0; i + 1 < attributes.size(); ++i) {
        if (attributes[i] == attributes.back()) return false;
      }
      if (attributes.back().empty() || !take("=\"") || !characters('"') || !take("\"")) return false;
    }
    if (take("/>")) return !tag.empty();
    if (!take(">")) return false;
    while (!take("</")) {
      if (here() == '<' ? !element() : !characters('<')) return false;
    }
    return name() == tag && take(">");
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// The value of the attribute in the last element before `at` that has it.
double number_before(const std::string& text, std::size_t at, const std::string& attribute) {
  const std::size_t begin = text.rfind(attribute + "=\"", at);
  return std::stod(text.substr(begin + attribute.size() + 2));
}

LogPlot plot_of(std::vector<PlotSeries> series) { return {"t", "x", "y", 1, {{"panel", std::move(series)}}}; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the reader of the tests knows what is well formed") {
    for (const char* good : {"<a/>", "<a b=\"1\"><c>x &amp; y</c></a>", "<?xml version=\"1.0\"?>\n<a>t</a>\n"}) {
      const std::string text = good;
      CHECK(XmlReader(text).is_well_formed());
    }
    for (const char* bad :
         {"", "<a>", "<a></b>", "<a b=1/>", "<a b=\"1\" b=\"2\"/>", "<a>&x</a>", "<a/><b/>", "<a>x"}) {
      const std::string text = bad;
      CAPTURE(text);
      CHECK_FALSE(XmlReader(text).is_well_formed());
    }
  }

  TEST_CASE("a plot is well formed and has one marker per point that can be drawn") {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    LogPlot plot{"a < b & \"c\"", "x, ns", "y > 0", 2, {}};
    std::size_t drawn = 0;
    for (int p = 0; p < 5; ++p) {
      PlotPanel panel{"panel <" + std::to_string(p) + ">", {}};
      for (int s = 0; s <= 2 * p; ++s) {
        PlotSeries series{"series & " + std::to_string(s), {}};
        for (int i = 0; i < 4; ++i, ++drawn) {
          series.points.push_back({10.0 * (i + 1), 0.1 / (i + s + 1), 0.05 / (i + s + 1), 0.2, i % 2 == 0});
        }
        series.points.push_back({nan, 1});
        series.points.push_back({1, 0});
        series.points.push_back({-1, 1});
        series.points.push_back({inf, 1});
        panel.series.push_back(series);
      }
      plot.panels.push_back(panel);
    }
    const std::string svg = log_plot_svg(plot);
    CHECK(XmlReader(svg).is_well_formed());
    CHECK(count_of(svg, "class=\"point\"") == drawn);
    CHECK(count_of(svg, "class=\"key\"") == 9);  // each name once
    CHECK(count_of(svg, "class=\"bar\"") == drawn);
    CHECK(count_of(svg, "class=\"frame\"") == 5);
    CHECK(count_of(svg, "class=\"front\"") == 5);
  }

  TEST_CASE("plots without anything to draw are well formed, too") {
    for (const LogPlot& plot : {LogPlot{}, plot_of({}), plot_of({{"empty", {}}}), plot_of({{"zero", {{0, 0}}}}),
                                plot_of({{"one", {{5, 5}}}})}) {
      const std::string svg = log_plot_svg(plot);
      CHECK(XmlReader(svg).is_well_formed());
      CHECK(svg.find("nan") == std::string::npos);
      CHECK(svg.find("inf") == std::string::npos);
    }
  }

  TEST_CASE("a point's place is the logarithm of its numbers: equal ratios are equal distances, more is right and up") {
    const std::string svg = log_plot_svg(plot_of({{"s", {{1, 1}, {10, 4}, {100, 16}, {1000, 64}}}}));
    std::vector<double> x, y;
    for (std::size_t at = svg.find("class=\"point\""); at != std::string::npos;
         at = svg.find("class=\"point\"", at + 1)) {
      x.push_back(number_before(svg, at, "cx"));
      y.push_back(number_before(svg, at, "cy"));
    }
    REQUIRE(x.size() == 4);
    for (std::size_t i = 1; i < 4; ++i) {
      CHECK(x[i] > x[i - 1]);
      CHECK(y[i] < y[i - 1]);
      // Written with one digit after the point.
      CHECK(x[i] - x[i - 1] == doctest::Approx(x[1] - x[0]).epsilon(0.15 / (x[1] - x[0])));
      CHECK(y[i - 1] - y[i] == doctest::Approx(y[0] - y[1]).epsilon(0.15 / (y[0] - y[1])));
    }
  }

  TEST_CASE("series have their own colour and marker up to forty-nine of them, the same in every panel") {
    LogPlot plot;
    plot.panels.resize(2);
    for (int s = 0; s < 49; ++s) {
      const PlotSeries series{"s" + std::to_string(s), {{1.0 + s, 2.0}}};
      plot.panels[0].series.push_back(series);
      plot.panels[1].series.insert(plot.panels[1].series.begin(), series);
    }
    const std::string svg = log_plot_svg(plot);
    std::vector<std::string> keys;
    for (std::size_t at = svg.find("class=\"key\""); at != std::string::npos; at = svg.find("class=\"key\"", at + 1)) {
      const std::size_t begin = svg.rfind('<', at), shape = svg.find("points=\"", begin);
      const std::string outline =
          svg.compare(begin, 7, "<circle") == 0 ? "circle" : svg.substr(shape, svg.find('"', shape + 8) - shape);
      const std::size_t stroke = svg.find("stroke=\"#", at);
      keys.push_back(outline + svg.substr(stroke, 16));
    }
    REQUIRE(keys.size() == 49);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) CHECK(keys[i] != keys[j]);
    }
    for (const std::string& key : keys) {
      const std::string colour = key.substr(key.size() - 16);
      CHECK(count_of(svg, "<g " + colour) == 2 * 7);  // seven series of each colour, in two panels
    }
  }

  TEST_CASE("an axis is marked at powers of ten, and more finely where they are few") {
    CHECK(log_ticks(1, 1000) == std::vector<double>{1, 10, 100, 1000});
    CHECK(log_ticks(3, 40) == std::vector<double>{5, 10, 20});
    for (const double lo : {1e-9, 0.03, 1.0, 7.0, 1e5}) {
      for (const double ratio : {1.3, 3.0, 12.0, 1e3, 1e6}) {
        for (const double tick : log_ticks(lo, lo * ratio)) {
          CHECK(tick >= lo);
          CHECK(tick <= lo * ratio);
        }
        // Neighbours in 1, 2, 5, 10 are at most 2.5 apart.
        if (ratio >= 2.5) CHECK_FALSE(log_ticks(lo, lo * ratio).empty());
      }
    }
  }
}
