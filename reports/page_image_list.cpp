// Which images of a run a page shows first.
#include "reports/page_image_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "study/cases.h"
#include "study/columns.h"

namespace moire {
namespace {

constexpr std::string_view kEnding = ".exr", kErrorEnding = ".error.exr";

// Rows with an error image of one scene, filter and estimator.
struct Contest {
  std::vector<const Row*> rows;
};

// Where a row stands in its contest: trial, how far its count is from the middle one, the smaller of two as far, then
// its place among the patterns.
struct Place {
  double trial, distance, spp;
  std::size_t among_patterns;
  friend auto operator<=>(const Place&, const Place&) = default;
};

// The largest error is 0, the smallest 1, the median 2, the others follow as they come.
std::vector<std::size_t> places_of_patterns(const std::vector<const Row*>& rows) {
  std::vector<std::size_t> by_error(rows.size()), place(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    by_error[i] = i;
    place[i] = i + 3;
  }
  std::stable_sort(by_error.begin(), by_error.end(), [&](std::size_t a, std::size_t b) {
    return rows[a]->number("rmse_active") > rows[b]->number("rmse_active");
  });
  place[by_error[rows.size() / 2]] = 2;
  place[by_error.back()] = 1;
  place[by_error.front()] = 0;
  return place;
}

void sort_by_place(Contest& contest) {
  std::set<double> counts;
  std::map<std::pair<double, double>, std::vector<const Row*>> fields;  // trial and count: one row per pattern
  for (const Row* row : contest.rows) {
    counts.insert(row->number("spp"));
    fields[{row->number("trial"), row->number("spp")}].push_back(row);
  }
  const auto index_of = [&](double spp) {
    return static_cast<double>(std::distance(counts.begin(), counts.find(spp)));
  };
  const auto middle = static_cast<double>((counts.size() - 1) / 2);
  std::vector<std::pair<Place, const Row*>> placed;
  for (const auto& [key, rows] : fields) {
    const std::vector<std::size_t> places = places_of_patterns(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      placed.push_back({{key.first, std::fabs(index_of(key.second) - middle), key.second, places[i]}, rows[i]});
    }
  }
  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  contest.rows.clear();
  for (const auto& [unused, row] : placed) contest.rows.push_back(row);
}

bool has_text(const Row& row, std::string_view column) { return !row.text(column).empty(); }

// Rows may come from any file: names lead to the run's own images and nowhere else.
bool is_own_image(std::string_view file, std::string_view ending) {
  constexpr std::string_view kFolder = "images/";
  return file.starts_with(kFolder) && file.ends_with(ending) && file.size() > kFolder.size() + ending.size() &&
         file.find('/', kFolder.size()) == std::string_view::npos;
}

// Whether a row has an error image and all that is said of one.
bool has_image(const Row& row) {
  const std::string_view file = row.text("image_error");
  return is_own_image(file, kErrorEnding) && file.rfind("_t") != std::string_view::npos &&
         std::isfinite(row.number("rmse_active")) && std::isfinite(row.number("spp")) &&
         std::isfinite(row.number("trial"));
}

std::vector<Contest> contests_of(const Table& rows) {
  std::vector<Contest> contests;
  std::map<std::string, std::size_t> index;
  for (const Row& row : rows) {
    if (!has_image(row)) continue;
    const std::string key = fmt::format("{}\n{}\n{}", row.text("scene"), row.text("filter"), row.text("estimator"));
    const auto [at, is_new] = index.try_emplace(key, contests.size());
    if (is_new) contests.emplace_back();
    contests[at->second].rows.push_back(&row);
  }
  for (Contest& contest : contests) sort_by_place(contest);
  return contests;
}

}  // namespace

std::string_view name_of(PageImage::Kind kind) {
  constexpr std::string_view kNames[] = {"exact", "error", "spectrum", "structured", "noise"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string label_of(const PageImage& image) {
  const Row& row = *image.row;
  const std::string kernel =
      Reconstruction{std::string(row.text("filter")), std::string(row.text("estimator"))}.label();
  if (image.kind == PageImage::Kind::exact) return fmt::format("exact: {}, {}", row.text("scene"), row.text("filter"));
  return fmt::format("{}: {}, {}, {:.0f} samples per pixel, {}{}", name_of(image.kind), row.text("scene"),
                     sampler_of(row), row.number("spp"), kernel,
                     image.kind == PageImage::Kind::error && row.number("trial") > 0
                         ? fmt::format(", trial {:.0f}", row.number("trial"))
                         : "");
}

std::string case_key(const Row& row) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{:.0f}", row.text("scene"), row.text("pattern"), row.text("layout"),
                     row.text("filter"), row.text("estimator"), row.number("spp"));
}

std::string spectra_stem(const Row& row_with_image) {
  std::string stem(row_with_image.text("image_error"));
  stem.resize(stem.rfind("_t"));  // of _t0.error.exr
  return stem;
}

std::vector<PageImage> images_by_rank(const Table& rows) {
  using Kind = PageImage::Kind;
  std::unordered_map<std::string, const Row*> spectra;
  for (const Row& row : rows) {
    if (has_text(row, "spectrum_window")) spectra[case_key(row)] = &row;
  }
  const std::vector<Contest> contests = contests_of(rows);
  std::size_t most = 0;
  for (const Contest& contest : contests) most = std::max(most, contest.rows.size());

  std::vector<PageImage> images;
  std::set<std::string> seen;
  const auto add = [&](Kind kind, std::string file, const Row* row) {
    if (!seen.insert(file).second) return;
    std::string exact;
    if (kind == Kind::error && is_own_image(row->text("image_exact"), kEnding)) exact = row->text("image_exact");
    images.push_back({kind, std::move(file), std::move(exact), row});
  };
  for (std::size_t turn = 0; turn < most; ++turn) {
    for (const Contest& contest : contests) {
      if (turn >= contest.rows.size()) continue;
      const Row* row = contest.rows[turn];
      if (is_own_image(row->text("image_exact"), kEnding)) add(Kind::exact, std::string(row->text("image_exact")), row);
      add(Kind::error, std::string(row->text("image_error")), row);
      const auto spectrum = spectra.find(case_key(*row));
      if (spectrum == spectra.end()) continue;
      const std::string stem = spectra_stem(*row);
      add(Kind::spectrum, stem + ".spectrum.exr", spectrum->second);
      // One realisation cannot be split.
      if (!std::isfinite(spectrum->second->number("noise_power"))) continue;
      add(Kind::structured, stem + ".structured.exr", spectrum->second);
      add(Kind::noise, stem + ".noise.exr", spectrum->second);
    }
  }
  return images;
}

}  // namespace moire
