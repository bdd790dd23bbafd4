//! ANALYZE of a column of boxes.

use super::column::STATISTICS_KIND;
use crate::types::Raw;
use engine::{Box3d, BoxStatistics};
use pgrx::{pg_extern, pg_guard, pg_sys};

/// Rows that ANALYZE samples for each step of the statistics target.
const ROWS_PER_TARGET: usize = 300;

/// Groups of boxes for each step of the statistics target: 1,600 at the default of 100, some 83 kB.
const GROUPS_PER_TARGET: usize = 16;

/// What the standard analysis asked for, which runs before ours.
struct Standard {
    compute: pg_sys::AnalyzeAttrComputeStatsFunc,
    data: *mut std::ffi::c_void,
}

/// Prepares the analysis of a column: the standard one, and ours after it.
#[pg_extern(stable, strict, parallel_safe)]
fn box3d_typanalyze(column: Raw<pg_sys::VacAttrStats>) -> bool {
    let column = column.as_ptr();
    // SAFETY: ANALYZE passes a column to prepare, and a context that outlives the analysis.
    unsafe {
        if !pg_sys::std_typanalyze(column) {
            return false;
        }
        let standard = pg_sys::MemoryContextAlloc((*column).anl_context, size_of::<Standard>())
            .cast::<Standard>();
        standard.write(Standard {
            compute: (*column).compute_stats,
            data: (*column).extra_data,
        });
        (*column).extra_data = standard.cast();
        (*column).compute_stats = Some(compute);
    }
    true
}

/// Computes the statistics of a column from its sample.
#[pg_guard]
unsafe extern "C-unwind" fn compute(
    column: pg_sys::VacAttrStatsP,
    fetch: pg_sys::AnalyzeAttrFetchFunc,
    rows: std::ffi::c_int,
    total: f64,
) {
    // SAFETY: box3d_typanalyze left the standard analysis there, and ANALYZE calls this once, with
    // what that one needs.
    unsafe {
        let standard = (*column).extra_data.cast::<Standard>().read();
        if let Some(compute) = standard.compute {
            (*column).extra_data = standard.data;
            compute(column, fetch, rows, total);
        }
        if !(*column).stats_valid {
            return;
        }
        let mut boxes = sample(column, fetch, rows);
        if boxes.is_empty() {
            return;
        }
        let target = usize::try_from((*column).minrows).unwrap_or(0) / ROWS_PER_TARGET;
        let groups = GROUPS_PER_TARGET * target.max(1);
        store(
            column,
            &BoxStatistics::of_sample(&mut boxes, groups).to_numbers(),
        );
    }
}

/// The boxes of a sample that are not null.
///
/// # Safety
/// The column must be of type box3d, and `fetch` and `rows` those of its sample.
unsafe fn sample(
    column: pg_sys::VacAttrStatsP,
    fetch: pg_sys::AnalyzeAttrFetchFunc,
    rows: std::ffi::c_int,
) -> Vec<Box3d> {
    let Some(fetch) = fetch else {
        return Vec::new();
    };
    (0..rows)
        .filter_map(|row| {
            let mut null = false;
            // SAFETY: the row is in the sample, and its datum, if there is one, points to a box.
            unsafe {
                let datum = fetch(column, row, &raw mut null);
                (!null).then(|| datum.cast_mut_ptr::<Box3d>().read())
            }
        })
        .collect()
}

/// Puts our numbers into the first free slot; there is one, as the standard analysis takes three
/// at most of five.
///
/// # Safety
/// The column must be one under analysis.
unsafe fn store(column: pg_sys::VacAttrStatsP, numbers: &[f32]) {
    // SAFETY: the numbers are copied to memory that lives as long as the analysis.
    unsafe {
        let column = &mut *column;
        let Some(slot) = column.stakind.iter().position(|&kind| kind == 0) else {
            return;
        };
        let copy =
            pg_sys::MemoryContextAlloc(column.anl_context, size_of_val(numbers)).cast::<f32>();
        copy.copy_from_nonoverlapping(numbers.as_ptr(), numbers.len());
        column.stakind[slot] = STATISTICS_KIND;
        column.stanumbers[slot] = copy;
        column.numnumbers[slot] = i32::try_from(numbers.len()).unwrap_or(0);
    }
}
