//! Who goes first when every core is busy: the keys.

/// How much nicer than the keys' thread those are that render.
#[cfg(target_os = "linux")]
const NICE: i32 = 5;

/// Lets other threads go before this one: to be called on threads that render. On an idle core it costs nothing, so times
/// that are measured stay what they are. Elsewhere than on Linux threads have no niceness of their own: nothing is done.
pub fn give_way() {
    #[cfg(target_os = "linux")]
    {
        use rustix::process::{getpriority_process, setpriority_process};
        let this = Some(rustix::thread::gettid());
        // If the system refuses, all threads go on as equals.
        if getpriority_process(this).is_ok_and(|nice| nice < NICE) {
            let _ = setpriority_process(this, NICE);
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn the_thread_alone_gives_way() {
        let nice = || rustix::process::getpriority_process(Some(rustix::thread::gettid())).unwrap();
        let before = nice();
        let there = std::thread::spawn(move || {
            give_way();
            nice()
        });
        assert_eq!(there.join().unwrap(), NICE.max(before));
        assert_eq!(nice(), before);
    }
}
