// All types of parameters that nodes share.
#pragma once

#include "design/ports/attribute_value.h"
#include "design/ports/choices.h"
#include "design/ports/file_names.h"
#include "design/ports/material_names.h"
#include "design/ports/numbers.h"
#include "design/ports/places.h"
#include "design/ports/solid_name.h"
#include "design/ports/voxel_weights.h"
