// What defines an image, as JSON text: scenes with the doubles stored, and parameters with their defaults filled in.
#pragma once

#include <string>

#include "filters/filter.h"
#include "patterns/pattern.h"
#include "study/scene_file.h"

namespace moire {

// {"name":...,"kind":...,"width":...,"height":..., then the stored doubles, each a list}.
std::string scene_json(const NamedScene& scene);

// {"filter":{"name":...,"key":value,...}}, with "pattern" before it when there is one.
std::string params_json(const PatternChoice* pattern, const Filter& filter);

}  // namespace moire
