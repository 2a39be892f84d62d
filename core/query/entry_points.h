#pragma once
// The body of a target's translation unit for queries. It is not the renderer's, so that what
// queries need cannot change the code of the render loop.

#include "core/kernel/targets.h"
#include "core/query/bsdf_queries.h"
#include "core/query/light_queries.h"
#include "core/query/path_watch.h"
#include "core/query/ray_queries.h"

namespace lightbench::LIGHTBENCH_TARGET {
extern const QueryTable<T> queries;
const QueryTable<T> queries = {trace_rays,       occlude_rays, leave_surfaces, sample_light_points,
                               pdf_light_points, eval_bsdfs,   sample_bsdfs,   watch_path};
}  // namespace lightbench::LIGHTBENCH_TARGET
