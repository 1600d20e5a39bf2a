//! What a figure is worth nothing without: on which machine, when, from which source it was measured.

use serde::Serialize;
use std::time::{SystemTime, UNIX_EPOCH};

/// Where figures come from.
#[derive(Clone, Debug, Serialize)]
pub struct Provenance {
    /// The command that measures them again.
    pub command: String,
    /// Version of this package.
    pub version: &'static str,
    /// The commit of the source, `-dirty` if it was changed since; absent where there is no repository.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// Date and time of the end of the measurement, UTC.
    pub date: String,
    /// The processor, as it names itself; absent where the system does not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu: Option<String>,
    /// Cores that this process may use.
    pub cores: usize,
    /// `x86_64 linux`
    pub platform: String,
    /// Was this program compiled with optimisation? Without, no figure means anything.
    pub optimised: bool,
}

impl Provenance {
    /// The facts of this machine and this build.
    #[must_use]
    pub fn gather(command: &str) -> Self {
        Self {
            command: command.into(),
            version: env!("CARGO_PKG_VERSION"),
            commit: commit(),
            date: utc_text(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())),
            cpu: std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| cpu_name(&text)),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            platform: format!("{} {}", std::env::consts::ARCH, std::env::consts::OS),
            optimised: !cfg!(debug_assertions),
        }
    }

    /// Two lines of text.
    #[must_use]
    pub fn text(&self) -> String {
        let cpu = self.cpu.as_deref().unwrap_or("unknown processor");
        let commit = self.commit.as_ref().map_or(String::new(), |commit| format!(", commit {commit}"));
        let warning = if self.optimised { "" } else { "\nNot an optimised build: these figures mean nothing." };
        format!(
            "{cpu}, {} cores, {}; ga-physics {}{commit}; {}\n`{}`{warning}",
            self.cores, self.platform, self.version, self.date, self.command
        )
    }
}

/// The commit that was built, as the build script found it.
fn commit() -> Option<String> {
    option_env!("GA_PHYSICS_COMMIT").map(str::to_string)
}

/// The first `model name` of `/proc/cpuinfo`.
fn cpu_name(text: &str) -> Option<String> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    let (_, name) = line.split_once(':')?;
    Some(name.trim().to_string()).filter(|name| !name.is_empty())
}

/// Seconds since 1970 as `2026-03-01T12:00:00Z`, in the proleptic Gregorian calendar.
fn utc_text(seconds: u64) -> String {
    let (mut days, time_s) = (seconds / 86_400, seconds % 86_400);
    let is_leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let lengths = [31, 28 + u64::from(is_leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 1;
    for length in lengths {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    let (hour, minute, second) = (time_s / 3600, time_s / 60 % 60, time_s % 60);
    format!("{year}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}Z", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Answers of `date -u -d @SECONDS`.
    #[test]
    fn dates_are_those_of_the_calendar() {
        assert_eq!(utc_text(0), "1970-01-01T00:00:00Z");
        assert_eq!(utc_text(951_782_399), "2000-02-28T23:59:59Z");
        assert_eq!(utc_text(951_868_799), "2000-02-29T23:59:59Z");
        assert_eq!(utc_text(951_868_800), "2000-03-01T00:00:00Z");
        assert_eq!(utc_text(4_107_542_399), "2100-02-28T23:59:59Z");
        assert_eq!(utc_text(4_107_542_400), "2100-03-01T00:00:00Z");
        assert_eq!(utc_text(1_798_761_599), "2026-12-31T23:59:59Z");
    }

    #[test]
    fn the_processor_names_itself() {
        assert_eq!(cpu_name("processor\t: 0\nmodel name\t: Some CPU @ 3 GHz\n").as_deref(), Some("Some CPU @ 3 GHz"));
        assert_eq!(cpu_name("model name\t:\n"), None);
        assert_eq!(cpu_name(""), None);
    }
}
