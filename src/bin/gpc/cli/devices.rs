//! `gpc devices`.

use super::{exit, print};
use clap::Args;
use gpc::vulkan::{DeviceInfo, Instance, InstanceOptions, MISSING_DRIVER_HELP};
use serde::Serialize;
use std::process::ExitCode;

/// Lists the Vulkan devices, and what each lacks; exits with 3 if none is suitable.
#[derive(Args)]
pub struct DevicesArgs {
    /// Print one JSON object: devices
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report<'a> {
    devices: &'a [DeviceInfo],
}

pub fn run(args: &DevicesArgs) -> anyhow::Result<ExitCode> {
    let devices = Instance::new(InstanceOptions::default())?.devices()?;
    if args.json {
        print::json(&Report { devices: &devices })?;
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
    let fitness = if device.missing.is_empty() {
        "suitable".to_owned()
    } else {
        format!("lacks {}", device.missing.join(", "))
    };
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
