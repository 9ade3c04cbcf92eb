use super::{Exit, args::VerifyArgs, exit::Failure};
use std::io::Write;
pub(super) fn verify(_a: &VerifyArgs, _o: &mut dyn Write) -> Result<Exit, Failure> {
    Ok(Exit::Done)
}
