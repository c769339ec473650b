//! Timers by the device's own clock.

use super::{Device, check};
use crate::error::Result;
use ash::vk;
use std::sync::Arc;
use std::time::Duration;

/// A pair of timestamps around some commands.
pub struct Timer {
    pub(super) pool: vk::QueryPool,
    device: Arc<Device>,
}

impl Timer {
    /// A timer that has measured nothing.
    pub fn new(device: &Arc<Device>) -> Result<Self> {
        let info = vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(2);
        // SAFETY: the device is valid.
        let pool = check("creating a timer", unsafe { device.raw.create_query_pool(&info, None) })?;
        Ok(Self { pool, device: Arc::clone(device) })
    }

    /// The time between start and stop, once the commands around them are done. None where the
    /// queue has no clock.
    pub fn elapsed(&self) -> Result<Option<Duration>> {
        if self.device.timestamp_period == 0.0 {
            return Ok(None);
        }
        let mut ticks = [0_u64; 2];
        // SAFETY: the pool has two queries, and both were written by the finished commands.
        let result = unsafe {
            self.device.raw.get_query_pool_results(
                self.pool,
                0,
                &mut ticks,
                vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT,
            )
        };
        check("reading a timer", result)?;
        let nanoseconds = ticks[1].saturating_sub(ticks[0]) as f64 * f64::from(self.device.timestamp_period);
        Ok(Some(Duration::from_nanos(nanoseconds as u64)))
    }
}

impl Drop for Timer {
    fn drop(&mut self) {
        // SAFETY: whoever records commands with the timer holds it until they are done.
        unsafe { self.device.raw.destroy_query_pool(self.pool, None) };
    }
}
