//! What is on disk: experiments, and the reports of earlier runs.
