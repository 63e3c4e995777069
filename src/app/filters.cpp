// moire filters: what filters do, in numbers.
#include "app/commands.h"
#include "app/output.h"
#include "filters/filter.h"
#include "reports/filter_table.h"
#include "reports/json.h"
#include "study/filter_table.h"

namespace moire {

Exit execute(const FiltersOptions& options) {
  std::vector<Filter> chosen;
  for (const std::string& text : options.filters.empty() ? filter_variants() : options.filters) {
    chosen.emplace_back(parse_spec(text, "FILTER"));
  }
  const Table table = filter_table(chosen);
  if (!options.json) {
    print(filter_text(table));
    return Exit::ok;
  }
  std::string text;
  for (const Row& row : table) text += (text.empty() ? "[" : ",\n ") + json_row(row, "");
  print(text + "]\n");
  return Exit::ok;
}

}  // namespace moire
