//! [`Column`], an expression of a query with what the planner knows about it.

use engine::BoxStatistics;
use pgrx::pg_sys;

/// Kind of our statistics in `pg_statistic`: a number drawn from 10000 to 30000, the range that
/// `catalog/pg_statistic.h` leaves to private use.
pub const STATISTICS_KIND: i16 = 27_183;

/// An expression that the planner examined; released when dropped.
pub struct Column {
    data: pg_sys::VariableStatData,
}

/// What ANALYZE found out about a column.
pub struct Analyzed {
    /// Its boxes.
    pub boxes: BoxStatistics,
    /// The share of its rows that are not null.
    pub present: f64,
}

impl Column {
    /// Takes over what the planner examined, with the reference that it holds.
    pub fn new(data: pg_sys::VariableStatData) -> Self {
        Self { data }
    }

    /// Examines an expression of a query.
    ///
    /// # Safety
    /// `node` must belong to the query of `root`.
    pub unsafe fn examine(root: *mut pg_sys::PlannerInfo, node: *mut pg_sys::Node) -> Self {
        let mut data = pg_sys::VariableStatData::default();
        // SAFETY: the planner fills in the whole of it.
        unsafe { pg_sys::examine_variable(root, node, 0, &raw mut data) };
        Self { data }
    }

    /// The column's statistics, if there are any and the operator may be used on them: a user
    /// without a right to all rows must not learn about them from estimates.
    pub fn analyzed(&mut self, operator: pg_sys::Oid) -> Option<Analyzed> {
        if self.data.statsTuple.is_null() {
            return None;
        }
        // SAFETY: the planner filled in the data, and the tuple is one of pg_statistic.
        unsafe {
            let function = pg_sys::get_opcode(operator);
            if !pg_sys::statistic_proc_security_check(&raw mut self.data, function) {
                return None;
            }
            analyzed(self.data.statsTuple)
        }
    }

    /// Rows of the column's relation that its own conditions leave.
    pub fn rows(&self) -> Option<f64> {
        // SAFETY: the relation, if there is one, belongs to the query being planned.
        unsafe { self.data.rel.as_ref() }.map(|relation| relation.rows)
    }
}

impl Drop for Column {
    fn drop(&mut self) {
        if let (false, Some(release)) = (self.data.statsTuple.is_null(), self.data.freefunc) {
            // SAFETY: what ReleaseVariableStats does, once.
            unsafe { release(self.data.statsTuple) };
        }
    }
}

/// Reads our statistics from a row of `pg_statistic`; `None` if there are none of this layout.
///
/// # Safety
/// The tuple must be a row of `pg_statistic`.
pub unsafe fn analyzed(tuple: pg_sys::HeapTuple) -> Option<Analyzed> {
    let mut slot = pg_sys::AttStatsSlot::default();
    // SAFETY: the slot's numbers are read before they are freed, and the fixed part of such a row
    // starts with FormData_pg_statistic.
    unsafe {
        let found = pg_sys::get_attstatsslot(
            &raw mut slot,
            tuple,
            STATISTICS_KIND.into(),
            pg_sys::InvalidOid,
            pg_sys::ATTSTATSSLOT_NUMBERS as i32,
        );
        if !found {
            return None;
        }
        let numbers = match usize::try_from(slot.nnumbers) {
            Ok(count) if count > 0 => std::slice::from_raw_parts(slot.numbers, count),
            _ => &[],
        };
        let boxes = BoxStatistics::from_numbers(numbers);
        pg_sys::free_attstatsslot(&raw mut slot);
        let row = &*fixed_part::<pg_sys::FormData_pg_statistic>(tuple);
        Some(Analyzed {
            boxes: boxes?,
            present: 1.0 - f64::from(row.stanullfrac),
        })
    }
}

/// The fixed part of a catalog's row.
///
/// # Safety
/// The tuple must be a row of the catalog whose rows start with a `T`.
pub unsafe fn fixed_part<T>(tuple: pg_sys::HeapTuple) -> *const T {
    // SAFETY: the data starts at the offset that the tuple's header tells, aligned for any type.
    unsafe {
        let header = (*tuple).t_data;
        header.cast::<u8>().add((*header).t_hoff.into()).cast()
    }
}
