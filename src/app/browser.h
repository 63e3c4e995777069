// A web browser without a window, for pages that draw themselves.
#pragma once

#include <functional>
#include <string>

namespace moire {

// The document of an HTML file as HTML, once Chromium has run its scripts. `fragment` is what stands behind # in its
// address. The browser is the program that $MOIRE_CHROMIUM names, or chromium, chromium-browser or google-chrome on
// $PATH; it has a profile of its own in `folder`, which the caller removes. Asks `stop` some ten times a second; true
// ends the browser. Throws Error for no browser (Exit::usage), for one that fails or takes more than kBrowserSeconds
// (Exit::io), and when it was stopped (Exit::interrupted).
inline constexpr int kBrowserSeconds = 120;
std::string rendered_document(const std::string& file, const std::string& fragment, const std::string& folder,
                              const std::function<bool()>& stop);

}  // namespace moire
