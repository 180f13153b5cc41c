// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkProgressFor_h
#define vtkProgressFor_h

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"

#include <algorithm>

/**
 * vtkSMPTools::For over [0, count) in batches, between which the filter reports its progress,
 * rising from `from` to `to`, and listens to AbortExecute. Events so come from the calling thread,
 * whatever the backend. Returns false when aborted.
 */
template <typename Functor>
bool vtkProgressFor(vtkAlgorithm* filter, vtkIdType count, vtkIdType batch, double from, double to,
  const Functor& functor)
{
  for (vtkIdType begin = 0; begin < count && !filter->GetAbortExecute(); begin += batch)
  {
    const vtkIdType end = std::min(begin + batch, count);
    // long ranges: each may begin with work that the one before it has done
    const vtkIdType threads = vtkSMPTools::GetEstimatedNumberOfThreads();
    const vtkIdType grain = std::max<vtkIdType>(1, (end - begin) / (8 * threads));
    vtkSMPTools::For(begin, end, grain, functor);
    filter->UpdateProgress(from + (to - from) * end / count);
  }
  return !filter->GetAbortExecute();
}

#endif
