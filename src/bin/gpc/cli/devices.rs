//! `gpc devices`.

use super::{exit, print};
use clap::Args;
use gpc::vulkan::{DeviceInfo, Instance, InstanceOptions, MISSING_DRIVER_HELP};
use serde::Serialize;
use std::process::ExitCode;

/// Options of `gpc devices`.
#[derive(Args)]
pub struct DevicesArgs {
    /// Print one JSON object: devices
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct DevicesReport<'a> {
    devices: Vec<Device<'a>>,
}

#[derive(Serialize)]
struct Device<'a> {
    name: &'a str,
    kind: &'a str,
    driver: &'a str,
    api: &'a str,
    subgroup_size: u32,
    memory_bytes: u64,
    missing: &'a [String],
}

impl<'a> Device<'a> {
    fn of(info: &'a DeviceInfo) -> Self {
        Self {
            name: &info.name,
            kind: info.kind,
            driver: &info.driver,
            api: &info.api,
            subgroup_size: info.subgroup_size,
            memory_bytes: info.memory_bytes,
            missing: &info.missing,
        }
    }
}

pub fn run(args: &DevicesArgs) -> anyhow::Result<ExitCode> {
    let devices = Instance::new(InstanceOptions::default())?.devices()?;
    if args.json {
        print::json(&DevicesReport { devices: devices.iter().map(Device::of).collect() })?;
    } else {
        for device in &devices {
            print::line(&text(device))?;
        }
    }
    if devices.iter().any(|device| device.missing.is_empty()) {
        return Ok(ExitCode::SUCCESS);
    }
    log::error!("no suitable Vulkan device. {MISSING_DRIVER_HELP}");
    Ok(ExitCode::from(exit::NO_DEVICE))
}

fn text(device: &DeviceInfo) -> String {
    let fitness =
        if device.missing.is_empty() { "suitable".to_owned() } else { format!("lacks {}", device.missing.join(", ")) };
    format!(
        "{}\n  {}, Vulkan {}, {}, {} MiB, subgroups of {}\n  {fitness}",
        device.name,
        device.kind,
        device.api,
        device.driver,
        device.memory_bytes >> 20,
        device.subgroup_size
    )
}
