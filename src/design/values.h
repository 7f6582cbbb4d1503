// All types of parameters that nodes share.
#pragma once

#include "design/ports/attribute_value.h"
#include "design/ports/files.h"
#include "design/ports/kernel.h"
#include "design/ports/material_names.h"
#include "design/ports/numbers.h"
#include "design/ports/places.h"
#include "design/ports/solid_name.h"
#include "design/ports/words.h"
