//! `wrinkle verify`: reports, made again and compared.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value as Json, json};

use super::Exit;
use super::args::VerifyArgs;
use super::exit::{Failure, tell};
use super::run::{halt_on_interrupt, use_threads, watched};
use super::summary::counted;
use crate::job::{self, Control, FileNow, Verified, VerifyError};

/// A report to verify.
struct Wanted {
    name: String,
    folder: PathBuf,
    /// The experiment's file, if it was named.
    file: Option<PathBuf>,
}

/// What one came to.
type Finding = Result<Verified, VerifyError>;

/// The most differences of a report that are shown; JSON has all.
const SHOWN: usize = 20;

/// Verifies the reports asked for, one after the other.
pub(super) fn verify(args: &VerifyArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let wanted = wanted(args)?;
    use_threads(args.threads)?;
    let control = Control::from(halt_on_interrupt());
    let mut findings = Vec::new();
    for report in &wanted {
        let verified = watched(&report.name, |watch| {
            job::verify(&report.folder, report.file.as_deref(), &control, watch)
        });
        let finding = match verified {
            Ok(Some(verified)) => Ok(verified),
            Ok(None) => {
                tell("interrupted: nothing is kept of a verification; begin it again");
                return Ok(Exit::Interrupted);
            }
            Err(error) => Err(error),
        };
        if !args.json {
            print(report, &finding, out)?;
        }
        findings.push(finding);
    }
    let same = findings.iter().filter(|finding| is_same(finding)).count();
    if args.json {
        let all: Vec<_> = wanted.iter().zip(&findings).map(|(w, f)| as_json(w, f)).collect();
        writeln!(out, "{:#}", json!({ "reports": all }))?;
    } else if findings.len() > 1 {
        writeln!(
            out,
            "{same} of {} are the same, byte for byte",
            counted(findings.len(), "report")
        )?;
    }
    Ok(if same == findings.len() { Exit::Done } else { Exit::Differs })
}

fn is_same(finding: &Finding) -> bool {
    finding.as_ref().is_ok_and(|verified| verified.differences.is_empty())
}

/// The reports that the arguments name.
fn wanted(args: &VerifyArgs) -> Result<Vec<Wanted>, Failure> {
    let named = |folder: PathBuf, file| {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Wanted { name, folder, file }
    };
    if args.reports.is_empty() {
        let all = job::reports_in(&args.out);
        if all.is_empty() {
            let out = args.out.display();
            return Err(Failure::wrong(format!(
                "there is no report in {out}; choose another folder with --out"
            )));
        }
        return Ok(all.into_iter().map(|folder| named(folder, None)).collect());
    }
    let one = |name: &String| {
        let path = Path::new(name);
        let is_file = path.extension().is_some_and(|e| e == "toml");
        let stem = if is_file { path.file_stem().unwrap_or_default() } else { path.as_os_str() };
        let folder = args.out.join(stem);
        let has = ["metrics.json", "evidence.json"].iter().any(|file| folder.join(file).is_file());
        if !has {
            return Err(Failure::wrong(VerifyError::NoReport(folder)));
        }
        Ok(named(folder, is_file.then(|| path.to_owned())))
    };
    args.reports.iter().map(one).collect()
}

/// A line a report, and one a file that differs.
fn print(report: &Wanted, finding: &Finding, out: &mut dyn Write) -> std::io::Result<()> {
    let style =
        |colour: anstyle::AnsiColor| anstyle::Style::new().fg_color(Some(colour.into())).bold();
    let (green, red) = (style(anstyle::AnsiColor::Green), style(anstyle::AnsiColor::Red));
    let name = &report.name;
    match finding {
        Ok(verified) if verified.differences.is_empty() => {
            writeln!(out, "{green}same{green:#}     {name}: {}", counted(verified.files, "file"))?;
        }
        Ok(verified) => {
            let (differ, files) = (verified.differences.len(), verified.files);
            writeln!(out, "{red}differs{red:#}  {name}: {differ} of {}", counted(files, "file"))?;
            for difference in verified.differences.iter().take(SHOWN) {
                writeln!(out, "  {}: {}", difference.file.display(), difference.what)?;
            }
            if differ > SHOWN {
                writeln!(out, "  and {} more; --json tells all", differ - SHOWN)?;
            }
        }
        Err(error) => writeln!(out, "{red}failed{red:#}   {name}: {error}")?,
    }
    if let Some(note) = finding.as_ref().ok().and_then(note) {
        writeln!(out, "  note: {note}")?;
    }
    Ok(())
}

/// What is to be said of the experiment's file.
fn note(verified: &Verified) -> Option<String> {
    Some(match verified.file.as_ref()? {
        FileNow::Changed(path) => format!(
            "{} was changed since; what was run again is the experiment as it stands in the report",
            path.display()
        ),
        FileNow::Gone => "the experiment's file is not here; what was run again is the experiment as it stands in the \
             report"
            .to_owned(),
    })
}

fn as_json(report: &Wanted, finding: &Finding) -> Json {
    let mut all = json!({
        "name": report.name,
        "folder": report.folder,
        "same": is_same(finding),
    });
    match finding {
        Ok(verified) => {
            let each = verified.differences.iter();
            let each = each.map(|d| json!({ "file": d.file, "difference": d.what }));
            all["files"] = json!(verified.files);
            all["differences"] = each.collect();
            all["note"] = json!(note(verified));
        }
        Err(error) => all["error"] = json!(error.to_string()),
    }
    all
}
