// What a report page shows, as JSON.
#include "reports/page_data.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "reports/json.h"
#include "reports/page_curves.h"
#include "reports/page_images.h"
#include "reports/page_json.h"
#include "study/file_names.h"

namespace moire {
namespace {

namespace fs = std::filesystem;

// Of the share of a run, for its radial spectra.
constexpr std::size_t kSpectraShare = 4;

// From the page's folder to the run's; "" where they are one.
std::string link_to(const std::string& folder, const std::string& page_folder) {
  std::error_code error;
  const fs::path from = fs::weakly_canonical(page_folder.empty() ? "." : page_folder, error);
  const std::string link = fs::weakly_canonical(folder, error).lexically_relative(from).generic_string();
  return link == "." || link.empty() ? "" : link + "/";
}

std::string name_of(const PageRun& run) {
  const std::string name = text_at(run.header, "/study/name");
  return name.empty() ? "run" : name;
}

std::string left_out_json(const std::vector<PageImage>& images, const std::string& link) {
  std::vector<std::string> items;
  for (const PageImage& image : images) {
    JsonObject item;
    item.add_text("file", link + image.file);
    item.add_text("label", label_of(image));
    items.push_back(std::move(item).text());
  }
  return packed_json(json_array(items));
}

std::string rows_json(const PageImages& images) {
  Table rows;
  for (const auto& item : images.kept) {
    if (item.image.kind == PageImage::Kind::error) rows.push_back(*item.image.row);
  }
  return packed_json(columns_json(rows));
}

std::string images_json(const PageImages& images) {
  std::vector<std::string> items;
  for (const auto& item : images.kept) items.push_back(item.json);
  return json_array(items);
}

// One line for all files that could not be read.
void add_notice(const PageRun& run, const std::vector<std::string>& faults, std::vector<std::string>& notices) {
  if (faults.empty()) return;
  // Where the run's folder is on this machine is nothing for a page.
  const std::string folder = run.folder + "/";
  const std::string first = faults.front().starts_with(folder) ? faults.front().substr(folder.size()) : faults.front();
  notices.push_back(
      std::to_string(faults.size()) +
      (faults.size() == 1 ? " part is missing in the page: " : " parts are missing in the page, first: ") + first);
}

std::string texts_json(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(json_text(text));
  return json_array(items);
}

// What comes of times: the page's bytes may depend on it, what the page holds may not.
bool is_time(std::string_view column) { return column.starts_with("time_") || column.ends_with("_at_equal_time"); }

// Bytes to set aside for a table: as it is without times, and at most kTimeBytes for each of these.
std::size_t planned_bytes(const Table& table) {
  constexpr std::size_t kTimeBytes = 16;
  Table plain(table.size());
  std::size_t times = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (const auto& [name, cell] : table[i].cells()) {
      if (is_time(name)) {
        ++times;
      } else {
        plain[i].set(name, cell);
      }
    }
  }
  return packed_json(columns_json(plain)).size() + kTimeBytes * times;
}

struct RunPart {
  std::string json;
  std::size_t planned = 0;           // bytes that were planned for it, whatever its times
  std::vector<std::string> notices;  // in the JSON, too
};

RunPart run_part(const PageRun& run, const RunPlace& place, std::size_t budget) {
  std::vector<std::string> notices = run.notices;
  const std::vector<PageImage> ranked = images_by_rank(run.rows);
  const PageCurves filters = page_filters(run.rows), points = page_points(run.rows),
                   spectra = page_spectra(ranked, place, budget / kSpectraShare);
  JsonObject object, tables;
  object.add_text("id", place.id);
  object.add_text("folder", place.link.substr(0, place.link.empty() ? 0 : place.link.size() - 1));
  object.add("header", run.header);
  object.add("filter_curves", filters.json);
  object.add("radial_spectra", spectra.json);
  object.add("points", points.json);
  // The list of everything as left out is about the longest that it may become.
  std::size_t planned = object.size() + left_out_json(ranked, place.link).size();
  for (const auto& [name, table] : run.tables) {
    tables.add(name, packed_json(columns_json(table)));
    planned += planned_bytes(table);
  }

  if (planned > budget) {
    notices.emplace_back(
        "The tables alone are as large as the run's share of the page's --budget, or larger: none of the run's images "
        "has room.");
  }
  PageImages images = page_images(ranked, place, budget - std::min(budget, planned));
  planned += images.bytes;
  for (const PageCurves* curves : {&filters, &points, &spectra}) add_notice(run, curves->faults, notices);
  add_notice(run, images.unreadable, notices);
  if (!notices.empty()) object.add("notices", texts_json(notices));
  for (;;) {
    std::vector<PageImage> left_out = images.left_out;
    left_out.insert(left_out.end(), spectra.left_out.begin(), spectra.left_out.end());
    JsonObject all_tables = tables, whole = object;
    if (!images.kept.empty()) all_tables.add("image_rows", rows_json(images));
    whole.add("tables", std::move(all_tables).text());
    whole.add("images", images_json(images));
    whole.add("left_out", left_out_json(left_out, place.link));
    std::string json = script_safe(std::move(whole).text());
    if (json.size() <= budget || images.kept.empty()) return {std::move(json), planned, notices};
    // Rows of results took more than was planned for them.
    images.left_out.push_back(std::move(images.kept.back().image));
    images.kept.pop_back();
  }
}

}  // namespace

PageData page_data(std::span<const PageRun> runs, const std::string& page_folder, std::size_t budget) {
  PageData page;
  std::vector<std::string> parts;
  std::set<std::string> names, ids;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string name = name_of(runs[i]);
    if (names.insert(name).second) page.title += (page.title.empty() ? "" : ", ") + name;
    std::string id = file_part(name);
    for (int copy = 2; !ids.insert(id).second; ++copy) id = file_part(name) + "-" + std::to_string(copy);
    // What one run does not need the next ones have.
    const std::size_t share = budget / (runs.size() - i);
    RunPart part = run_part(runs[i], {runs[i].folder, link_to(runs[i].folder, page_folder), id}, share);
    for (const std::string& notice : part.notices) page.notices.push_back(runs[i].folder + ": " + notice);
    budget -= std::min(budget, part.planned);
    parts.push_back(std::move(part.json));
  }
  JsonObject object;
  object.add_text("schema", "moire.report/1");
  object.add_text("title", page.title);
  object.add("runs", json_array(parts));
  page.json = script_safe(std::move(object).text());
  return page;
}

}  // namespace moire
